#pragma once

#include <string>

namespace gonio {

/// e.g. "angle of incidence" for theta_i; another name stays as it is.
[[nodiscard]] std::string component_words(const std::string& name);

}  // namespace gonio

#pragma once

#include <string_view>

namespace gonio {

/// A file of reports/templates as it was when gonio was built.
/// @param name  e.g. "page.mustache".
/// @throws std::out_of_range  if there is none of that name.
[[nodiscard]] std::string_view template_text(std::string_view name);

}  // namespace gonio

#pragma once

#include <string>

namespace gonio {

/// What gnuplot writes to standard output for a script. It runs as a process of its own, without a
/// shell, without the settings of its user, and has ended when this returns or throws.
/// @throws std::system_error  if it cannot be run, or ends otherwise than well.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace gonio

#pragma once

namespace gonio::conformance {

/// What the program's exit says.
enum ExitStatus { conforms = 0, does_not_conform = 1, bad_input = 2, environment_failed = 3 };

/// gonio-conformance, after GoogleTest has taken its own arguments.
/// @throws InputError, std::invalid_argument  for an option or a file that is wrong.
[[nodiscard]] int run_program(int argc, char** argv);

}  // namespace gonio::conformance

#pragma once

#include <string>
#include <vector>

namespace gonio {

/// A program that is run without a shell, and what it is for.
struct Command {
  std::vector<std::string> arguments;         ///< first the program, sought on the path
  std::string purpose = {};                   ///< for an error, e.g. "which draws the charts"
  std::vector<std::string> environment = {};  ///< besides PATH and LC_ALL=C, e.g. "HOME=/tmp"
};

/// Runs a program to its end. It sees nothing of the environment but what `command` says.
/// @param input  what it reads from its standard input.
/// @return       what it writes to standard output.
/// @throws std::system_error  if it cannot be run, or ends otherwise than well, with what it
///                            complains of; when it returns or throws the program has ended.
[[nodiscard]] std::string run_to_end(const Command& command, const std::string& input);

/// The first of these programs that is on the path; empty if none is.
[[nodiscard]] std::string first_on_path(const std::vector<std::string>& programs);

}  // namespace gonio

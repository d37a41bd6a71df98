#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gonio {

/// A YAML file, and all files that it names under keys `file`, each once, in the order in which
/// they are named; resolved. Files that those name in turn are not looked for.
/// @throws InputError  if it is no YAML, or a file that it names is not there.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& yaml);

/// SHA-256 of the text of a YAML file and of all files that it names, 64 hexadecimal digits: it
/// changes with any byte of any of them, but not with the folder that they lie in.
/// @throws InputError  as files_of.
[[nodiscard]] std::string hash_of_file(const std::filesystem::path& yaml);

}  // namespace gonio

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gonio {

/// What a path leads to: "a file", "a folder", "something else" or "nothing".
[[nodiscard]] std::string what_stands_at(const std::filesystem::path& path);

/// The text of an input file, without a byte order mark.
/// @throws InputError  if it is missing, not a regular file, empty, or larger than 16 MiB.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Writes a file whole or not at all: a temporary file beside it, then a rename. When it returns
/// the file survives a power failure, as far as the file system can promise that.
/// @throws std::system_error  with the path, if that fails; an older file is then unchanged, or
///                            replaced whole.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace gonio

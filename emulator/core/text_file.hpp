#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace gonio {

/// What a path leads to: "a file", "a folder", "something else" or "nothing".
[[nodiscard]] std::string what_stands_at(const std::filesystem::path& path);

/// The text of an input file, without a byte order mark.
/// @throws InputError  if it is missing, not a regular file, empty, or larger than that.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, int largest_mib = 16);

/// Writes a file whole or not at all: a temporary file beside it, then a rename. When it returns
/// the file survives a power failure, as far as the file system can promise that. A device or a
/// pipe is written to as it stands.
/// @throws std::system_error  with the path, if that fails; an older file is then unchanged, or
///                            replaced whole. So it is for whatever `write` throws.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);
/// The same for a text at hand.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace gonio

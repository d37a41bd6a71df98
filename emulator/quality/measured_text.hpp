#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gonio {

/// The text of a table that an instrument or a spreadsheet exported, as UTF-8.
/// @throws InputError  for a file that is neither UTF-8 nor UTF-16 with its low byte first and a
///                     byte order mark, at the first byte that is no text; and for one that cannot
///                     be read or is larger than 1 GiB.
[[nodiscard]] std::string read_measured_text(const std::filesystem::path& file);

/// The delimiter that the header of a table uses: tab, semicolon or comma, the first of them that
/// stands in it outside quotes; tab if none does.
[[nodiscard]] char delimiter_of(std::string_view text);

}  // namespace gonio

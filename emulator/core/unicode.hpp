#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gonio {

/// What is no text in a string of bytes.
struct BadText {
  std::size_t position;  ///< of the byte
  std::string what;      ///< e.g. "the byte 0xFF", "the control character U+001B"
};

/// The first byte that is not UTF-8, or the first control character other than tab and line break.
/// @return  nothing if all of `bytes` is text.
[[nodiscard]] std::optional<BadText> find_bad_text(std::string_view bytes);

/// UTF-16, little endian, as UTF-8.
/// @return  nothing if `bytes` is not UTF-16.
[[nodiscard]] std::optional<std::string> utf8_from_utf16(std::string_view bytes);

/// A place in a text; both count from 1.
struct TextPlace {
  int line = 1;
  int column = 1;  ///< in characters
};
/// @param position  of a byte of `text`, which is UTF-8 up to there.
[[nodiscard]] TextPlace place_in_text(std::string_view text, std::size_t position);

}  // namespace gonio

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

}  // namespace gonio

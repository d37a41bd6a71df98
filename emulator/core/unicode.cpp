#include "emulator/core/unicode.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace gonio {

namespace {

/// How many bytes follow the first one of a character; nothing if no character begins with it.
std::optional<std::size_t> following_bytes(unsigned char first) {
  if (first < 0x80) {
    return 0;
  }
  if (first < 0xC2 || first > 0xF4) {
    return std::nullopt;
  }
  return first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
}

struct Character {
  char32_t code;
  std::size_t size;
};

/// The character that `bytes` begin with; nothing if that is not UTF-8.
std::optional<Character> first_character(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes.front());
  const auto following = following_bytes(first);
  if (!following || bytes.size() <= *following) {
    return std::nullopt;
  }
  char32_t code = *following == 0 ? first : first & (0x3Fu >> *following);
  for (const char c : bytes.substr(1, *following)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0u) != 0x80u) {
      return std::nullopt;
    }
    code = (code << 6) | (byte & 0x3Fu);
  }
  const bool overlong = (*following == 2 && code < 0x800) || (*following == 3 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (overlong || surrogate || code > 0x10FFFF) {
    return std::nullopt;
  }
  return Character{code, *following + 1};
}

bool is_control(char32_t code) {
  return (code < 0x20 && code != '\t' && code != '\n' && code != '\r') ||
         (code >= 0x7F && code < 0xA0);
}

}  // namespace

std::optional<BadText> find_bad_text(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto character = first_character(bytes.substr(i));
    if (!character) {
      return BadText{i, fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(bytes[i]))};
    }
    if (is_control(character->code)) {
      return BadText{i, fmt::format("the control character U+{:04X}",
                                    static_cast<std::uint32_t>(character->code))};
    }
    i += character->size;
  }
  return std::nullopt;
}

}  // namespace gonio

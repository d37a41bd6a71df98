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

void append(std::string& text, char32_t code) {
  const auto following = [&](int shift) { text += char(0x80u | ((code >> shift) & 0x3Fu)); };
  if (code < 0x80) {
    text += char(code);
  } else if (code < 0x800) {
    text += char(0xC0u | (code >> 6));
    following(0);
  } else if (code < 0x10000) {
    text += char(0xE0u | (code >> 12));
    following(6);
    following(0);
  } else {
    text += char(0xF0u | (code >> 18));
    following(12);
    following(6);
    following(0);
  }
}

/// The unit of 16 bits that begins at `i`; 0, which is no half of a pair, at the end.
char32_t unit_at(std::string_view bytes, std::size_t i) {
  if (i + 1 >= bytes.size()) {
    return 0;
  }
  return static_cast<unsigned char>(bytes[i]) |
         (char32_t(static_cast<unsigned char>(bytes[i + 1])) << 8);
}

}  // namespace

std::optional<std::string> utf8_from_utf16(std::string_view bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    char32_t code = unit_at(bytes, i);
    if (code >= 0xD800 && code < 0xDC00) {  // the first half of a pair
      const char32_t second = unit_at(bytes, i += 2);
      if (second < 0xDC00 || second >= 0xE000) {
        return std::nullopt;
      }
      code = 0x10000 + ((code - 0xD800) << 10) + (second - 0xDC00);
    } else if (i + 1 == bytes.size() || (code >= 0xDC00 && code < 0xE000)) {
      return std::nullopt;
    }
    append(text, code);
  }
  return text;
}

TextPlace place_in_text(std::string_view text, std::size_t position) {
  TextPlace place;
  for (const char c : text.substr(0, position)) {
    if (c == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u) {
      ++place.column;
    }
  }
  return place;
}

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

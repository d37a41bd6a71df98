#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::test {

using Bytes = std::vector<std::uint8_t>;

/// The bytes of pairs of hexadecimal digits; blanks do not count.
/// @throws std::invalid_argument  for anything else.
inline Bytes bytes_of_hex(std::string_view text) {
  const auto digit = [&](char c) {
    if (std::isxdigit(static_cast<unsigned char>(c)) == 0) {
      throw std::invalid_argument(fmt::format("expected pairs of hex digits, found '{}'", text));
    }
    return static_cast<unsigned>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
  };
  std::string digits;
  for (const char c : text) {
    if (c != ' ') {
      digits += c;
    }
  }
  if (digits.size() % 2 != 0) {
    throw std::invalid_argument(fmt::format("expected pairs of hex digits, found '{}'", text));
  }
  Bytes bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(digit(digits[i]) << 4U | digit(digits[i + 1])));
  }
  return bytes;
}

/// Pairs of upper case hexadecimal digits, a blank between them.
inline std::string hex(std::span<const std::uint8_t> bytes) {
  return fmt::format("{:02X}", fmt::join(bytes.begin(), bytes.end(), " "));
}

}  // namespace gonio::test

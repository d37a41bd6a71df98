#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/unit/hex.hpp"

namespace gonio::test {

/// Bytes as they are expected: some may be anything.
struct BytePattern {
  std::vector<std::optional<std::uint8_t>> bytes = {};
  bool is_open = false;  ///< any number of bytes may follow

  [[nodiscard]] bool matches(std::span<const std::uint8_t> found) const {
    if (found.size() < bytes.size() || (found.size() > bytes.size() && !is_open)) {
      return false;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (bytes[i].value_or(found[i]) != found[i]) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& byte : bytes) {
      text += byte ? fmt::format("{:02X} ", *byte) : ".. ";
    }
    return text + (is_open ? "..." : "");
  }
};

/// Reads the texts of fixtures/wire: pairs of hex digits, FF*300, {name}, {crc}, {bad_crc},
/// {start}, and in what is expected `..` and `...`.
class WireText {
 public:
  using Addresses = std::map<std::string, std::uint16_t>;

  explicit WireText(const Addresses& addresses, std::uint8_t unit)
      : addresses_(addresses), unit_(unit) {}

  /// @throws std::invalid_argument  saying what was expected and what was found.
  [[nodiscard]] BytePattern pattern(const std::string& text) {
    pattern_ = {};
    crc_begin_ = 0;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      if (pattern_.is_open) {
        throw std::invalid_argument("expected nothing after '...', found '" + word + "'");
      }
      take(word);
    }
    return pattern_;
  }
  /// The same for what is sent, every byte of which is known.
  [[nodiscard]] Bytes bytes(const std::string& text) {
    (void)pattern(text);
    if (pattern_.is_open) {
      throw std::invalid_argument("expected a byte to send, found '...'");
    }
    return known_bytes(0);
  }

 private:
  void take(const std::string& word) {
    if (word == "...") {
      pattern_.is_open = true;
    } else if (word == "..") {
      pattern_.bytes.emplace_back();
    } else if (word.front() == '{' && word.back() == '}') {
      take_name(word.substr(1, word.size() - 2));
    } else if (const std::size_t star = word.find('*'); star != std::string::npos) {
      append(Bytes(std::stoul(word.substr(star + 1)), bytes_of_hex(word.substr(0, star)).at(0)));
    } else {
      append(bytes_of_hex(word));
    }
  }
  void take_name(const std::string& name) {
    if (name == "unit") {
      append({unit_});
    } else if (name == "start") {
      crc_begin_ = pattern_.bytes.size();
    } else if (name == "crc" || name == "bad_crc") {
      const int mistake = name == "crc" ? 0 : 0xFFFF;
      const auto crc = static_cast<std::uint16_t>(modbus::crc16(known_bytes(crc_begin_)) ^ mistake);
      append({modbus::low_byte(crc), modbus::high_byte(crc)});
      crc_begin_ = pattern_.bytes.size();
    } else if (const auto address = addresses_.find(name); address != addresses_.end()) {
      append({modbus::high_byte(address->second), modbus::low_byte(address->second)});
    } else {
      throw std::invalid_argument("expected the name of an address, found '" + name + "'");
    }
  }
  void append(const Bytes& bytes) {
    pattern_.bytes.insert(pattern_.bytes.end(), bytes.begin(), bytes.end());
  }
  [[nodiscard]] Bytes known_bytes(std::size_t begin) const {
    Bytes known;
    for (std::size_t i = begin; i < pattern_.bytes.size(); ++i) {
      if (!pattern_.bytes[i]) {
        throw std::invalid_argument("expected a byte that is known, found '..'");
      }
      known.push_back(*pattern_.bytes[i]);
    }
    return known;
  }

  const Addresses& addresses_;
  std::uint8_t unit_;
  BytePattern pattern_;
  std::size_t crc_begin_ = 0;
};

}  // namespace gonio::test

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/hex.hpp"

namespace gonio::conformance {

using test::Bytes;
using test::hex;

/// Bytes as they are expected: some may be anything.
struct BytePattern {
  std::vector<std::optional<std::uint8_t>> bytes = {};
  bool is_open = false;  ///< any number of bytes may follow

  [[nodiscard]] bool matches(std::span<const std::uint8_t> found) const;
  [[nodiscard]] std::string text() const;
};

/// What() says what was expected, and what was found.
class WireTextError : public std::invalid_argument {
 public:
  WireTextError(std::string expected, std::string found)
      : std::invalid_argument(fmt::format("expected {}, found '{}'", expected, found)),
        expected_(std::move(expected)),
        found_(std::move(found)) {}
  [[nodiscard]] const std::string& expected() const { return expected_; }
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  std::string expected_, found_;
};

/// Reads the texts of wire cases: pairs of hex digits, FF*300, {name}, {crc}, {bad_crc}, {start},
/// and in what is expected `..` and `...`.
class WireText {
 public:
  using Addresses = std::map<std::string, std::uint16_t>;

  explicit WireText(const Addresses& addresses, std::uint8_t unit)
      : addresses_(addresses), unit_(unit) {}

  /// @throws WireTextError
  [[nodiscard]] BytePattern pattern(const std::string& text);
  /// The same for what is sent, every byte of which is known.
  [[nodiscard]] Bytes bytes(const std::string& text);

 private:
  void take(const std::string& word);
  void take_name(const std::string& name);
  void append(const Bytes& bytes);
  [[nodiscard]] Bytes known_bytes(std::size_t begin) const;

  const Addresses& addresses_;
  std::uint8_t unit_;
  BytePattern pattern_;
  std::size_t crc_begin_ = 0;
};

}  // namespace gonio::conformance

#include "tests/conformance/wire_text.hpp"

#include <sstream>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/wire_number.hpp"

namespace gonio::conformance {

namespace {

Bytes bytes_of_hex(const std::string& word) {
  try {
    return test::bytes_of_hex(word);
  } catch (const std::invalid_argument&) {
    throw WireTextError("pairs of hex digits", word);
  }
}

std::size_t repetitions(const std::string& digits) {
  constexpr std::size_t most_digits = 5;
  if (digits.empty() || digits.size() > most_digits ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw WireTextError("a number of repetitions", digits);
  }
  return std::stoul(digits);
}

}  // namespace

bool BytePattern::matches(std::span<const std::uint8_t> found) const {
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

std::string BytePattern::text() const {
  std::string text;
  for (const auto& byte : bytes) {
    text += byte ? fmt::format("{:02X} ", *byte) : ".. ";
  }
  return text + (is_open ? "..." : "");
}

BytePattern WireText::pattern(const std::string& text) {
  pattern_ = {};
  crc_begin_ = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (pattern_.is_open) {
      throw WireTextError("nothing after '...'", word);
    }
    take(word);
  }
  return pattern_;
}

Bytes WireText::bytes(const std::string& text) {
  (void)pattern(text);
  if (pattern_.is_open) {
    throw WireTextError("a byte to send", "...");
  }
  return known_bytes(0);
}

void WireText::take(const std::string& word) {
  if (word == "...") {
    pattern_.is_open = true;
  } else if (word == "..") {
    pattern_.bytes.emplace_back();
  } else if (word.front() == '{' && word.back() == '}') {
    take_name(word.substr(1, word.size() - 2));
  } else if (const std::size_t star = word.find('*'); star != std::string::npos) {
    const std::uint8_t byte = bytes_of_hex(word.substr(0, star)).at(0);
    pattern_.bytes.insert(pattern_.bytes.end(), repetitions(word.substr(star + 1)), byte);
  } else {
    append(bytes_of_hex(word));
  }
}

void WireText::take_name(const std::string& name) {
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
    throw WireTextError("the name of an address", name);
  }
}

void WireText::append(const Bytes& bytes) {
  pattern_.bytes.insert(pattern_.bytes.end(), bytes.begin(), bytes.end());
}

Bytes WireText::known_bytes(std::size_t begin) const {
  Bytes known;
  for (std::size_t i = begin; i < pattern_.bytes.size(); ++i) {
    if (!pattern_.bytes[i]) {
      throw WireTextError("a byte that is known", "..");
    }
    known.push_back(*pattern_.bytes[i]);
  }
  return known;
}

}  // namespace gonio::conformance

#include "emulator/protocol/rtu_framer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gonio::modbus {

namespace {

constexpr std::size_t unit_size = 1, crc_size = 2;

constexpr auto crc_of_byte = [] {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < table.size(); ++byte) {
    unsigned crc = byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xA001U : crc >> 1U;
    }
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

bool has_right_crc(std::span<const std::uint8_t> frame) {
  const std::size_t end = frame.size() - crc_size;
  return crc16(frame.first(end)) == (frame[end] | frame[end + 1] << 8U);  // low byte first
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc = crc >> 8U ^ crc_of_byte[(crc ^ byte) & 0xFFU];
  }
  return static_cast<std::uint16_t>(crc);
}

std::chrono::microseconds silence_between_frames(int baud) {
  constexpr int bits = 11, highest_baud_in_characters = 19200;
  if (baud <= 0) {
    throw std::invalid_argument(
        fmt::format("silence_between_frames: {} baud, expected more than 0", baud));
  }
  if (baud > highest_baud_in_characters) {
    return std::chrono::microseconds(1750);
  }
  const int character_halves = 7;
  return std::chrono::microseconds((character_halves * bits * 1'000'000 / 2 + baud - 1) / baud);
}

void RtuFramer::feed(std::span<const std::uint8_t> bytes, Time now) {
  if (bytes.empty()) {
    return;
  }
  if (is_over(now)) {
    forget();  // the frame before, which nobody fetched
    ++dropped_;
  }
  last_ = now;
  is_begun_ = true;
  is_spoiled_ = is_spoiled_ || bytes.size() > buffer_.size() - size_;
  if (!is_spoiled_) {
    std::copy(bytes.begin(), bytes.end(), buffer_.begin() + std::ptrdiff_t(size_));
    size_ += bytes.size();
  }
}

std::optional<RtuFramer::Time> RtuFramer::deadline() const {
  return is_begun_ ? std::optional(last_ + silence_) : std::nullopt;
}

std::optional<RtuFrame> RtuFramer::end_of_frame(Time now) {
  if (!is_over(now)) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> frame = std::span(buffer_).first(size_);
  const bool is_good = !is_spoiled_ && frame.size() > unit_size + crc_size && has_right_crc(frame);
  forget();
  if (!is_good) {
    ++dropped_;
    return std::nullopt;
  }
  return RtuFrame{.unit = frame[0],
                  .pdu = frame.subspan(unit_size, frame.size() - unit_size - crc_size)};
}

void RtuFramer::forget() {
  size_ = 0;
  is_begun_ = is_spoiled_ = false;
}

std::size_t write_rtu_frame(std::uint8_t unit, std::span<const std::uint8_t> pdu,
                            std::span<std::uint8_t> out) {
  const std::size_t size = unit_size + pdu.size() + crc_size;
  if (pdu.empty() || pdu.size() > max_pdu || out.size() < size) {
    throw std::length_error("write_rtu_frame: PDU of the wrong size, or no room for it");
  }
  out[0] = unit;
  std::copy(pdu.begin(), pdu.end(), out.begin() + unit_size);
  const std::uint16_t crc = crc16(out.first(unit_size + pdu.size()));
  out[size - 2] = static_cast<std::uint8_t>(crc & 0xFFU);
  out[size - 1] = static_cast<std::uint8_t>(crc >> 8U);
  return size;
}

}  // namespace gonio::modbus

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gonio::modbus {

constexpr std::uint8_t high_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value >> 8U);
}
constexpr std::uint8_t low_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value & 0xFFU);
}

/// The number at `offset` and the byte after it, high byte first.
constexpr std::uint16_t u16_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint16_t>(bytes[offset] << 8U | bytes[offset + 1]);
}

}  // namespace gonio::modbus

#include "emulator/protocol/register_codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gonio {

namespace {

// Marks among int16; those among int32 are the same with zeros or ones behind.
constexpr std::uint16_t missing_int16 = 0x8000, over_range_int16 = 0x7FFF;
constexpr std::uint32_t missing_int32 = 0x8000'0000, over_range_int32 = 0x7FFF'FFFF;
constexpr std::uint32_t missing_float32 = 0x7FC0'0000;  // a quiet NaN

void put_u32(const Point& point, std::uint32_t word, std::span<std::uint16_t> out) {
  out[point.is_word_swapped ? 1 : 0] = static_cast<std::uint16_t>(word >> 16U);
  out[point.is_word_swapped ? 0 : 1] = static_cast<std::uint16_t>(word & 0xFFFFU);
}

std::uint32_t get_u32(const Point& point, std::span<const std::uint16_t> registers) {
  const std::uint32_t high = registers[point.is_word_swapped ? 1 : 0];
  return high << 16U | registers[point.is_word_swapped ? 0 : 1];
}

template <class Signed, class Unsigned>
Unsigned signed_integer(double value, Unsigned missing, Unsigned over_range) {
  if (std::isnan(value)) {
    return missing;
  }
  if (std::isinf(value) && value > 0.0) {
    return over_range;
  }
  using Limits = std::numeric_limits<Signed>;
  const double rounded =
      std::clamp(std::round(value), double{Limits::min()} + 1.0, double{Limits::max()} - 1.0);
  return static_cast<Unsigned>(static_cast<Signed>(rounded));
}

template <class Unsigned>
Unsigned unsigned_integer(double value) {
  constexpr double highest = std::numeric_limits<Unsigned>::max();
  return std::isfinite(value) ? static_cast<Unsigned>(std::clamp(std::round(value), 0.0, highest))
                              : std::numeric_limits<Unsigned>::max();
}

std::uint32_t float32(double value) {
  return std::isfinite(value) ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                              : missing_float32;
}

}  // namespace

void encode_number(const Point& point, double value, std::span<std::uint16_t> out) {
  switch (point.type) {
    case PointType::boolean:
      out[0] = value == 1.0 ? 1 : 0;
      break;
    case PointType::int16:
      out[0] = signed_integer<std::int16_t>(value / point.scale, missing_int16, over_range_int16);
      break;
    case PointType::uint16:
      out[0] = unsigned_integer<std::uint16_t>(value);
      break;
    case PointType::int32:
      put_u32(point, signed_integer<std::int32_t>(value, missing_int32, over_range_int32), out);
      break;
    case PointType::uint32:
      put_u32(point, unsigned_integer<std::uint32_t>(value), out);
      break;
    case PointType::float32:
      put_u32(point, float32(value), out);
      break;
    case PointType::text:
      break;
  }
}

void encode_text(std::string_view text, std::span<std::uint16_t> out) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<std::uint16_t>(byte(2 * i) << 8U | byte(2 * i + 1));
  }
}

double decode_number(const Point& point, std::span<const std::uint16_t> registers) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double over_range = std::numeric_limits<double>::infinity();
  switch (point.type) {
    case PointType::int16:
      return registers[0] == missing_int16 ? none
             : registers[0] == over_range_int16
                 ? over_range
                 : static_cast<std::int16_t>(registers[0]) * point.scale;
    case PointType::int32:
      return static_cast<std::int32_t>(get_u32(point, registers));
    case PointType::uint32:
      return get_u32(point, registers);
    case PointType::float32:
      return std::bit_cast<float>(get_u32(point, registers));
    case PointType::boolean:
    case PointType::uint16:
      return registers[0];
    case PointType::text:
      break;
  }
  return none;
}

std::string decode_text(std::span<const std::uint16_t> registers) {
  std::string text;
  for (const std::uint16_t word : registers) {
    text += static_cast<char>(word >> 8U);
    text += static_cast<char>(word & 0xFFU);
  }
  return text.substr(0, text.find('\0'));
}

}  // namespace gonio

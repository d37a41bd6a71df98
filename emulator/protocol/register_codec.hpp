#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// Writes a number into the registers of a point, in its type, scale and word order.
///
/// @param value  NaN for one that there is none of, infinity for one over range: both NaN as
///               float32; 8000 and 7FFF as int16; all ones as unsigned. Numbers that an integer
///               cannot hold become the nearest that is no such mark.
/// @param out    shape (point.registers).
void encode_number(const Point& point, double value, std::span<std::uint16_t> out);

/// Writes ASCII, two characters per register, the first in the high byte; cut, or filled up with
/// NUL, to the registers of the point.
void encode_text(std::string_view text, std::span<std::uint16_t> out);

/// The number in the registers of a point, in its unit.
/// @return  NaN and infinity as above for float32 and int16; unsigned integers use all their range.
[[nodiscard]] double decode_number(const Point& point, std::span<const std::uint16_t> registers);

/// The text in registers, up to the first NUL.
[[nodiscard]] std::string decode_text(std::span<const std::uint16_t> registers);

}  // namespace gonio

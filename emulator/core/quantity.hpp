#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace gonio {

/// The values that a number of an input file may take, and how to say so.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is not allowed
  bool high_open = false;  ///< high itself is not allowed

  [[nodiscard]] bool contains(double value) const;  ///< false for NaN
  [[nodiscard]] std::string text() const;           ///< e.g. " > 0", " in [0, 1]"; empty if any

  static Range any() { return {}; }
  static Range positive() { return {.low = 0.0, .low_open = true}; }
  static Range not_negative() { return {.low = 0.0}; }
  static Range closed(double low, double high) { return {.low = low, .high = high}; }
};

/// A kind of quantity, with the units that an input file may state it in.
enum class Dimension { number, angle, length, gloss, time, temperature, temperature_difference };

/// The number in `text` in the base unit of its dimension: 1, radian, nanometre, GU, second, degree
/// Celsius, kelvin.
/// Numbers are read without regard to the locale; "60 deg", "+0.5 nm", "0.1 GU", "10 ms", "23
/// degC".
/// @return  nothing if the text is not a finite number followed by a unit of that dimension.
[[nodiscard]] std::optional<double> parse_quantity(std::string_view text, Dimension dimension);

/// What an input file should hold there, e.g. "an angle (deg, rad, mrad)".
[[nodiscard]] std::string expected_quantity(Dimension dimension);

}  // namespace gonio

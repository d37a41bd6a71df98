#pragma once

#include <algorithm>
#include <cmath>

namespace gonio {

/// What an axis shows. gnuplot refuses one without length, and one of no numbers at all.
struct AxisSpan {
  double low, high;

  void include(double value) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  /// At least that long, the same on both sides.
  [[nodiscard]] AxisSpan at_least(double length) const {
    const double more = std::max(0.0, length - (high - low)) / 2.0;
    return {low - more, high + more};
  }
  /// A twentieth more on both sides.
  [[nodiscard]] AxisSpan with_room() const {
    const double room = 0.05 * (high - low);
    return {low - room, high + room};
  }
  /// From 0 to 1 if it has no length.
  [[nodiscard]] AxisSpan or_unit() const { return high > low ? *this : AxisSpan{0.0, 1.0}; }
};

}  // namespace gonio

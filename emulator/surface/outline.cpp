#include "emulator/surface/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio {

double Outline::area_mm2() const {
  const double form = kind == Kind::rectangle ? 4.0 : std::numbers::pi;
  return form * half_length_mm * half_width_mm;
}

std::optional<Chord> Outline::chord(double y) const {
  const double t = (y - y_mm) / half_width_mm;
  if (!(std::abs(t) < 1.0)) {
    return std::nullopt;
  }
  const double half =
      kind == Kind::rectangle ? half_length_mm : half_length_mm * std::sqrt((1.0 - t) * (1.0 + t));
  return Chord{x_mm - half, x_mm + half};
}

std::optional<Chord> common(const Chord& a, const Chord& b) {
  const Chord both{std::max(a.low, b.low), std::min(a.high, b.high)};
  return both.low < both.high ? std::optional(both) : std::nullopt;
}

}  // namespace gonio

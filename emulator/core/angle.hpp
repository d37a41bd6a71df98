#pragma once

#include <compare>
#include <numbers>

namespace gonio {

/// A plane angle. Made by `degrees(60)` or `radians(1.047)`, so that neither unit passes for the
/// other across an interface.
class Angle {
 public:
  constexpr Angle() = default;
  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }

  constexpr auto operator<=>(const Angle&) const = default;
  constexpr Angle operator-() const { return Angle(-radians_); }
  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator*(double factor, Angle a) { return Angle(factor * a.radians_); }

 private:
  explicit constexpr Angle(double radians) : radians_(radians) {}
  friend constexpr Angle radians(double value);
  friend constexpr Angle degrees(double value);
  double radians_ = 0.0;
};

[[nodiscard]] constexpr Angle radians(double value) { return Angle(value); }
[[nodiscard]] constexpr Angle degrees(double value) {
  return Angle(value * (std::numbers::pi / 180.0));
}

}  // namespace gonio

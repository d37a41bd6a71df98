#pragma once

#include <compare>

namespace gonio {

/// A length, and so a wavelength too. Made by `nanometres(550)` or `micrometres(0.55)`.
class Length {
 public:
  constexpr Length() = default;
  [[nodiscard]] constexpr double nanometres() const { return nanometres_; }
  [[nodiscard]] constexpr double micrometres() const { return nanometres_ * 1e-3; }

  constexpr auto operator<=>(const Length&) const = default;

 private:
  explicit constexpr Length(double nanometres) : nanometres_(nanometres) {}
  friend constexpr Length nanometres(double value);
  double nanometres_ = 0.0;
};

using Wavelength = Length;

[[nodiscard]] constexpr Length nanometres(double value) { return Length(value); }
[[nodiscard]] constexpr Length micrometres(double value) { return nanometres(value * 1e3); }

}  // namespace gonio

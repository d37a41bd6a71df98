#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "emulator/core/length.hpp"

namespace gonio {

/// One of the nine dispersion formulas of the refractiveindex.info database.
///
/// With l the wavelength in micrometres and C1, C2, ... the coefficients, missing ones being 0:
///
///   1 Sellmeier    n^2 = 1 + C1 + C2 l^2/(l^2 - C3^2) + C4 l^2/(l^2 - C5^2) + ...
///   2 Sellmeier-2  n^2 = 1 + C1 + C2 l^2/(l^2 - C3) + C4 l^2/(l^2 - C5) + ...
///   3 polynomial   n^2 = C1 + C2 l^C3 + C4 l^C5 + ...
///   4 general      n^2 = C1 + C2 l^C3/(l^2 - C4^C5) + C6 l^C7/(l^2 - C8^C9) + C10 l^C11 + ...
///   5 Cauchy       n = C1 + C2 l^C3 + C4 l^C5 + ...
///   6 gases        n = 1 + C1 + C2/(C3 - l^-2) + C4/(C5 - l^-2) + ...
///   7 Herzberger   n = C1 + C2/(l^2 - 0.028) + C3/(l^2 - 0.028)^2 + C4 l^2 + C5 l^4 + C6 l^6
///   8 retro        (n^2 - 1)/(n^2 + 2) = C1 + C2 l^2/(l^2 - C3) + C4 l^2
///   9 exotic       n^2 = C1 + C2/(l^2 - C3) + C4 (l - C5)/((l - C5)^2 + C6)
///
/// @see refractiveindex.info database, "Dispersion formulas"
class DispersionFormula {
 public:
  /// @param number        1 to 9.
  /// @param coefficients  C1, C2, ...; at least one, at most most_coefficients(number).
  /// @throws std::invalid_argument  if an argument is outside its range.
  DispersionFormula(int number, std::span<const double> coefficients);

  /// Refractive index n; NaN or infinite where the formula has no value, which the caller checks.
  [[nodiscard]] double at(Wavelength lambda) const;

  /// @throws std::invalid_argument  unless number is 1 to 9.
  [[nodiscard]] static std::size_t most_coefficients(int number);

 private:
  int number_;
  std::array<double, 17> c_{};  // c_[0] is C1
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "emulator/core/wavelength_grid.hpp"

namespace gonio {

/// CIE tristimulus values; Y is 100 for the perfect reflector.
struct Xyz {
  double X = 0.0;
  double Y = 0.0;
  double Z = 0.0;
};

/// CIE chromaticity coordinates.
struct Chromaticity {
  double x = 0.0;
  double y = 0.0;
};

/// CIE 1976 L*, a*, b*.
struct Lab {
  double L = 0.0;
  double a = 0.0;
  double b = 0.0;
};

/// Colour-matching functions on a grid, each of shape (n_lambda).
struct Observer {
  Eigen::ArrayXd x_bar;
  Eigen::ArrayXd y_bar;
  Eigen::ArrayXd z_bar;

  /// @param path  CSV file: the wavelength in nm, and columns x_bar, y_bar, z_bar.
  /// @throws InputError  if the file is not of this form or does not cover the grid.
  [[nodiscard]] static Observer load(const std::filesystem::path& path, const WavelengthGrid& grid);
};

/// Tristimulus values of a reflecting object, summed over an equally spaced grid.
///
///   X = k sum R S x_bar,  k = 100 / sum S y_bar;  Y and Z alike
///
/// @param reflectance  R, shape (n_lambda), dimensionless.
/// @param illuminant   S, relative spectral power, shape (n_lambda), in any unit.
/// @param observer     colour-matching functions on the same grid.
/// @throws std::invalid_argument  if the lengths differ, or sum S y_bar is not > 0.
/// @see    ISO/CIE 11664-3
[[nodiscard]] Xyz tristimulus(const Eigen::ArrayXd& reflectance, const Eigen::ArrayXd& illuminant,
                              const Observer& observer);

/// Tristimulus values of the perfect reflector: the white point of an illuminant.
/// @throws std::invalid_argument  as tristimulus().
[[nodiscard]] Xyz white_point(const Eigen::ArrayXd& illuminant, const Observer& observer);

/// @throws std::domain_error  unless X + Y + Z > 0.
[[nodiscard]] Chromaticity chromaticity(const Xyz& colour);

/// CIELAB coordinates.
///
///   L = 116 f(Y/Y_n) - 16,  a = 500 (f(X/X_n) - f(Y/Y_n)),  b = 200 (f(Y/Y_n) - f(Z/Z_n))
///   f(t) = t^(1/3) for t > (6/29)^3, else (841/108) t + 4/29
///
/// @param white  X_n, Y_n, Z_n, each > 0.
/// @throws std::domain_error  if white is outside its range.
/// @see    ISO/CIE 11664-4
[[nodiscard]] Lab cielab(const Xyz& colour, const Xyz& white);

/// Weights of lightness, chroma and hue in CIEDE2000; 1 under the reference conditions.
struct Ciede2000Weights {
  double k_L = 1.0;
  double k_C = 1.0;
  double k_H = 1.0;
};

/// CIEDE2000 colour difference, >= 0; symmetric in its two colours.
/// @see  ISO/CIE 11664-6; with the hue rules of Sharma, Wu, Dalal, Color Res. Appl. 30 (2005) 21
[[nodiscard]] double ciede2000(const Lab& first, const Lab& second,
                               const Ciede2000Weights& weights = {});

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "emulator/core/wavelength_grid.hpp"

namespace gonio {

/// The CIE components of daylight on a grid, each of shape (n_lambda).
struct DaylightComponents {
  Eigen::ArrayXd S_0;
  Eigen::ArrayXd S_1;
  Eigen::ArrayXd S_2;

  /// @param path  CSV file: the wavelength in nm, and columns S0, S1, S2.
  /// @throws InputError  if the file is not of this form or does not cover the grid.
  [[nodiscard]] static DaylightComponents load(const std::filesystem::path& path,
                                               const WavelengthGrid& grid);
};

/// The constant c_2 of Planck's law has changed since D50, D55, D65 and D75 got their names: their
/// correlated colour temperature is the named one times this.
inline constexpr double daylight_name_to_cct = 1.4388 / 1.4380;

/// Relative spectral power of a CIE daylight illuminant, 100 at 560 nm.
///
///   S = S_0 + M_1 S_1 + M_2 S_2, M_1 and M_2 rounded to three decimals
///
/// @param cct_k  correlated colour temperature, in [4000, 25000] K; for D65
///               6500 * daylight_name_to_cct.
/// @return       shape (n_lambda).
/// @throws std::domain_error  if cct_k is outside its range or NaN.
/// @see    CIE 15, method of calculating D illuminants
[[nodiscard]] Eigen::ArrayXd daylight(double cct_k, const DaylightComponents& components);

}  // namespace gonio

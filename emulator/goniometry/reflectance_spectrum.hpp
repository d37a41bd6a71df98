#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"

namespace gonio {

/// Spectral reflectance relative to a perfect mirror, measured in one geometry.
/// @see [Mihalik] section 6
struct ReflectanceSpectrum {
  std::string geometry;          ///< id, such as "60"
  Eigen::ArrayXd wavelength_nm;  ///< ascending, shape (n)
  Eigen::ArrayXd reflectance;    ///< >= 0 but for noise, shape (n)
  Eigen::ArrayXd u = {};         ///< standard uncertainty, > 0, shape (n); empty: not known
  SourceMark mark = {};          ///< where it stands
};

/// Reads spectra from a CSV file: the column `wavelength_nm`, which ascends, a column for each
/// geometry, named by its id, and, where it is known, a column `u_<id>` of its standard
/// uncertainty. An empty cell is no value.
/// @throws InputError  for anything else, with line and column.
[[nodiscard]] std::vector<ReflectanceSpectrum> load_reflectance_spectra(
    const std::filesystem::path& path);

/// The same as text that load_reflectance_spectra reads back to the last bit. Where a spectrum has
/// no value at a wavelength of another its cells are empty.
[[nodiscard]] std::string reflectance_spectra_csv(const std::vector<ReflectanceSpectrum>& spectra);

}  // namespace gonio

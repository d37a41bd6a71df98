#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "emulator/core/input_error.hpp"

namespace gonio {

/// How files of counts are written.
struct CountsFormat {
  char delimiter = ',';
  char decimal = '.';
};

/// What a spectrometer counted: repeats of one measurement.
struct Counts {
  Eigen::ArrayXd axis;      ///< number of the pixel, or wavelength [nm]; ascending, shape (n)
  Eigen::ArrayXXd repeats;  ///< shape (n, n_repeats), n_repeats >= 1
  SourceMark mark = {};
};

/// Reads a table of the axis and one column of counts for each repeat. A first row whose first cell
/// is no number is a header; rows that begin with `#` are comments.
/// @throws InputError  for anything else, with line and column; for less than two rows.
[[nodiscard]] Counts load_counts(const std::filesystem::path& path, const CountsFormat& format);

}  // namespace gonio

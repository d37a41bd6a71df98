#pragma once

#include <algorithm>
#include <cmath>

#include "tests/unit/csv_rows.hpp"
#include "tests/unit/measured/measured_fixture.hpp"

namespace gonio::test {

/// How far a BRDF is from the reference slices, relative to them, up to 80 degrees: what was
/// measured of the materials of RGL.
struct SliceErrors {
  double rms = 0.0, largest = 0.0, of_peak = 0.0;
};

inline SliceErrors slice_errors(const MeasuredBrdf& brdf, const std::string& material,
                                double theta_i_deg) {
  const Eigen::Array3d luminance(0.2126, 0.7152, 0.0722);  // of the linear sRGB primaries
  SliceErrors errors;
  int n = 0;
  for (const CsvRow& row : csv_rows(brdf_fixtures + "rgl_reference_slices.csv")) {
    const double theta_r_deg = row.number("theta_o_deg");
    if (!row.text("file").starts_with(material) || row.number("theta_i_deg") != theta_i_deg ||
        std::abs(theta_r_deg) > 80.0) {
      continue;
    }
    const Eigen::Array3d rgb = Eigen::Array3d(row.number("R"), row.number("G"), row.number("B")) /
                               std::cos(degrees(theta_r_deg).radians());
    const Eigen::ArrayXd got = in_plane(brdf, theta_i_deg, theta_r_deg);
    const double error = got.size() == 3 ? ((got - rgb) / rgb).abs().maxCoeff()
                                         : std::abs(got[0] / (rgb * luminance).sum() - 1.0);
    errors.rms += error * error;
    errors.largest = std::max(errors.largest, error);
    if (theta_r_deg == theta_i_deg) {
      errors.of_peak = error;
    }
    ++n;
  }
  errors.rms = std::sqrt(errors.rms / std::max(n, 1));
  return n > 0 ? errors : SliceErrors{.rms = NAN, .largest = NAN, .of_peak = NAN};
}

}  // namespace gonio::test

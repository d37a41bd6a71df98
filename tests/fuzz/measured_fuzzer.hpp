#pragma once

#include <cmath>

#include "emulator/measured/brdf_file.hpp"
#include "tests/fuzz/require.hpp"

namespace gonio::test {

/// What holds for every measured BRDF that could be read.
inline void check(const BrdfFile& file) {
  require(file.brdf != nullptr, "a file that is read has a BRDF");
  const MeasuredBrdf& brdf = *file.brdf;
  require(!brdf.channels().empty(), "there are channels");
  DirectionBatch omega_r;
  omega_r.resize(5);
  omega_r.x << 0.0, 0.6, -0.6, 0.0, 1.0;
  omega_r.y << 0.0, 0.0, 0.48, 0.999, 0.0;
  omega_r.z << 1.0, 0.8, 0.64, std::sqrt(1.0 - 0.999 * 0.999), 0.0;
  Eigen::ArrayXXd f_r(5, Eigen::Index(brdf.channels().size()));
  for (const Vector3& omega_i : {Vector3(0.0, 0.0, 1.0), Vector3(-0.6, 0.0, 0.8),
                                 Vector3(0.64, -0.48, 0.6), Vector3(0.0, 1.0, 1e-9)}) {
    brdf.evaluate(omega_i, omega_r, f_r);
    require((f_r >= 0.0).all() && f_r.isFinite().all(), "f_r is a number, not negative");
    require((f_r.row(4) == 0.0).all(), "nothing is reflected below the surface");
  }
  for (const double theta_deg : {0.0, 60.0, 85.0}) {
    const double step = brdf.step(degrees(theta_deg)).radians();
    require(step >= 0.0 && step < 4.0, "a step is an angle");
  }
  const double largest = brdf.largest_theta().radians();
  require(largest >= 0.0 && largest < 1.6, "what was measured is above the surface");
}

}  // namespace gonio::test

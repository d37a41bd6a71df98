#pragma once

#include <cmath>

#include "emulator/core/input_error.hpp"
#include "emulator/measured/measured_brdf.hpp"
#include "tests/fuzz/require.hpp"

namespace gonio::test {

/// What holds for every measured BRDF, tried at directions about the hemisphere.
inline void require_brdf(const MeasuredBrdf& brdf) {
  require(!brdf.channels().empty(), "a channel at least");
  require(brdf.step(degrees(45.0)).radians() >= 0.0, "a step");
  const double largest = brdf.largest_theta().degrees();
  require(largest >= 0.0 && largest <= 90.0 + 1e-9, "polar angles to 90 degrees");
  DirectionBatch omega_r;
  omega_r.resize(12);
  for (Eigen::Index i = 0; i < omega_r.size(); ++i) {
    const double theta = 0.14 * double(i), phi = 2.5 * double(i);
    omega_r.x[i] = std::sin(theta) * std::cos(phi);
    omega_r.y[i] = std::sin(theta) * std::sin(phi);
    omega_r.z[i] = std::cos(theta);
  }
  Eigen::ArrayXXd f_r(omega_r.size(), Eigen::Index(brdf.channels().size()));
  for (const double theta_i : {0.0, 0.3, 1.5}) {
    brdf.evaluate({-std::sin(theta_i), 0.0, std::cos(theta_i)}, omega_r, f_r);
    require((f_r >= 0.0).all(), "f_r that is a number, and not negative");
  }
}

/// Takes what a reader makes of a text, and that it refuses it; nothing else.
template <typename Read>
void require_brdf_or_refusal(const Read& read) {
  try {
    require_brdf(*read().brdf);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace gonio::test

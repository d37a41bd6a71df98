#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/optics/direction.hpp"

// The formulas of two lobes as one writes them down from their papers, one pair of directions at a
// time: what the batched kernels are measured against.

namespace gonio::bench {

/// D G / (4 cos i cos r) [1/sr] with Beckmann's D and V-shaped grooves.
/// @param m  rms slope, > 0.   @see [Mihalik] eq. (13), (14)
inline double plain_cook_torrance(double m, const Vector3& omega_i, const Vector3& omega_r) {
  const double cos_i = omega_i.z();
  const double cos_r = omega_r.z();
  if (cos_i <= 0.0 || cos_r <= 0.0) {
    return 0.0;
  }
  const Vector3 h = (omega_i + omega_r).normalized();
  const double cos_a = h.z();
  const double cos_d = omega_i.dot(h);
  const double cos2_a = cos_a * cos_a;
  const double m2 = m * m;
  const double D =
      std::exp(-(1.0 - cos2_a) / (cos2_a * m2)) / (std::numbers::pi * m2 * cos2_a * cos2_a);
  const double G = std::min({1.0, 2.0 * cos_a * cos_i / cos_d, 2.0 * cos_a * cos_r / cos_d});
  return D * G / (4.0 * cos_i * cos_r);
}

/// Smith's Lambda of the distribution of Trowbridge and Reitz.
inline double plain_smith_lambda(double alpha, double cos_theta) {
  const double cos2 = cos_theta * cos_theta;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - cos2) / cos2) - 1.0);
}

/// D G / (4 cos i cos r) [1/sr] with the distribution of Trowbridge and Reitz and Smith's
/// height-correlated masking.
/// @param alpha  in (0, 1].   @see Walter et al., EGSR 2007; Heitz, JCGT 3(2), 2014
inline double plain_ggx(double alpha, const Vector3& omega_i, const Vector3& omega_r) {
  const double cos_i = omega_i.z();
  const double cos_r = omega_r.z();
  if (cos_i <= 0.0 || cos_r <= 0.0) {
    return 0.0;
  }
  const Vector3 h = (omega_i + omega_r).normalized();
  const double cos2_a = h.z() * h.z();
  const double a2 = alpha * alpha;
  const double spread = a2 + (1.0 - cos2_a) / cos2_a;
  const double D = a2 / (std::numbers::pi * cos2_a * cos2_a * spread * spread);
  const double G =
      1.0 / (1.0 + plain_smith_lambda(alpha, cos_i) + plain_smith_lambda(alpha, cos_r));
  return D * G / (4.0 * cos_i * cos_r);
}

}  // namespace gonio::bench

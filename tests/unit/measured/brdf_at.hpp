#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "emulator/core/angle.hpp"
#include "emulator/measured/measured_brdf.hpp"

namespace gonio::test {

inline Vector3 direction(double theta_deg, double phi_deg) {
  const double theta = degrees(theta_deg).radians();
  const double phi = degrees(phi_deg).radians();
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// f_r [1/sr] of one pair of directions, in all channels.
inline Eigen::ArrayXd f_r_at(const MeasuredBrdf& brdf, const Vector3& omega_i,
                             const Vector3& omega_r) {
  DirectionBatch batch;
  batch.resize(1);
  batch.x(0) = omega_r.x();
  batch.y(0) = omega_r.y();
  batch.z(0) = omega_r.z();
  Eigen::ArrayXXd result(1, Eigen::Index(brdf.channels().size()));
  brdf.evaluate(omega_i, batch, result);
  return result.row(0).transpose();
}

/// Directional-hemispherical reflectance per channel: the sum over n x n midpoints in theta, phi.
inline Eigen::ArrayXd rho_of(const MeasuredBrdf& brdf, const Vector3& omega_i, int n) {
  DirectionBatch batch;
  batch.resize(Eigen::Index(n) * n);
  Eigen::ArrayXd weight(batch.size());
  for (int t = 0; t < n; ++t) {
    for (int p = 0; p < n; ++p) {
      const Vector3 omega = direction(90.0 * (t + 0.5) / n, 360.0 * (p + 0.5) / n);
      const Eigen::Index j = Eigen::Index(t) * n + p;
      batch.x(j) = omega.x();
      batch.y(j) = omega.y();
      batch.z(j) = omega.z();
      weight(j) = omega.z() * std::hypot(omega.x(), omega.y()) * (std::numbers::pi / 2.0 / n) *
                  (2.0 * std::numbers::pi / n);
    }
  }
  Eigen::ArrayXXd f_r(batch.size(), Eigen::Index(brdf.channels().size()));
  brdf.evaluate(omega_i, batch, f_r);
  return (f_r.colwise() * weight).colwise().sum().transpose();
}

}  // namespace gonio::test

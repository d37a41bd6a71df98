#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio::test {

inline const std::string brdf_fixtures = GONIO_SOURCE_DIR "/fixtures/brdf/";

/// A unit vector by angles in degrees, polar ones of any sign.
inline Vector3 direction_at(double theta_deg, double phi_deg) {
  const double theta = degrees(theta_deg).radians(), phi = degrees(phi_deg).radians();
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// f_r of all channels, of one pair of directions.
inline Eigen::ArrayXd value_of(const MeasuredBrdf& brdf, const Vector3& omega_i,
                               const Vector3& omega_r) {
  DirectionBatch batch;
  batch.resize(1);
  batch.x[0] = omega_r.x();
  batch.y[0] = omega_r.y();
  batch.z[0] = omega_r.z();
  Eigen::ArrayXXd f_r(1, Eigen::Index(brdf.channels().size()));
  brdf.evaluate(omega_i, batch, f_r);
  return f_r.row(0).transpose();
}

/// In the plane of incidence, of light from azimuth pi: theta_r is negative on the source's side.
inline Eigen::ArrayXd in_plane(const MeasuredBrdf& brdf, double theta_i_deg, double theta_r_deg) {
  return value_of(brdf, direction_at(theta_i_deg, 180.0), direction_at(theta_r_deg, 0.0));
}

}  // namespace gonio::test

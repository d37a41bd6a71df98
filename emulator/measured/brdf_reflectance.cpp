#include "emulator/measured/brdf_reflectance.hpp"

#include <cmath>
#include <numbers>

namespace gonio {

Eigen::ArrayXd directional_hemispherical_reflectance(const MeasuredBrdf& brdf, Angle theta_i,
                                                     Angle rotation) {
  constexpr Eigen::Index n_radial = 192, n_azimuth = 120;
  constexpr double pi = std::numbers::pi;
  const double sin_i = std::sin(theta_i.radians()), cos_i = std::cos(theta_i.radians());
  const double sin_rotation = std::sin(rotation.radians());
  const double cos_rotation = std::cos(rotation.radians());
  DirectionBatch omega_r;
  omega_r.resize(n_radial * n_azimuth);
  Eigen::ArrayXd weights(omega_r.size());
  for (Eigen::Index i = 0; i < n_radial; ++i) {
    // midpoints in u of radial = pi u^3, for a lobe of any width about the mirror direction
    const double u = (double(i) + 0.5) / double(n_radial);
    const double radial = pi * u * u * u;
    const double solid_angle =
        std::sin(radial) * 3.0 * pi * u * u / double(n_radial) * 2.0 * pi / double(n_azimuth);
    for (Eigen::Index j = 0; j < n_azimuth; ++j) {
      const double azimuth = (double(j) + 0.5) * 2.0 * pi / double(n_azimuth);
      const double along = std::cos(radial), across = std::sin(radial) * std::cos(azimuth);
      const Eigen::Index at = i * n_azimuth + j;
      const double x = sin_i * along - cos_i * across, y = -std::sin(radial) * std::sin(azimuth);
      omega_r.x[at] = cos_rotation * x - sin_rotation * y;
      omega_r.y[at] = sin_rotation * x + cos_rotation * y;
      omega_r.z[at] = cos_i * along + sin_i * across;
      weights[at] = solid_angle * std::max(omega_r.z[at], 0.0);
    }
  }
  Eigen::ArrayXXd f_r(omega_r.size(), Eigen::Index(brdf.channels().size()));
  brdf.evaluate({-sin_i * cos_rotation, -sin_i * sin_rotation, cos_i}, omega_r, f_r);
  return (f_r.colwise() * weights).colwise().sum().transpose();
}

}  // namespace gonio

#include "emulator/surface/albedo.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

double lobe_albedo(const Shape& shape, double parameter, double cos_theta_i,
                   const std::function<double(double)>& factor) {
  constexpr int steps = 16;     // on each side of the mirror direction
  constexpr double step = 0.4;  // in rms slopes; exp(-(pi / step)^2) is rounding
  constexpr Eigen::Index n = Eigen::Index{2 * steps + 1} * (steps + 1);
  const double scale = step * shape.slope_width(parameter, cos_theta_i).x;
  const Vector3 omega_i(-std::sqrt(1.0 - cos_theta_i * cos_theta_i), 0.0, cos_theta_i);
  DirectionBatch omega_r;
  omega_r.resize(n);
  Eigen::ArrayXd weight(n);
  Eigen::Index at = 0;
  for (int a = -steps; a <= steps; ++a) {
    for (int b = 0; b <= steps; ++b, ++at) {  // the other half is the same
      const Vector3 h = Vector3(scale * a, scale * b, 1.0).normalized();
      const double cos_d = omega_i.dot(h);
      const Vector3 omega = 2.0 * cos_d * h - omega_i;
      omega_r.x(at) = omega.x();
      omega_r.y(at) = omega.y();
      omega_r.z(at) = omega.z();
      // d omega_r = 4 cos_d d omega_h, d omega_h = cos^3(h) dp dq
      weight(at) = cos_d > 0.0 && omega.z() > 0.0
                       ? (b == 0 ? 1.0 : 2.0) * scale * scale * std::pow(h.z(), 3) * 4.0 * cos_d *
                             omega.z() * factor(std::min(cos_d, 1.0))
                       : 0.0;
    }
  }
  Eigen::ArrayXd g(n);
  shape.evaluate(parameter, omega_i, omega_r, g);
  return (weight > 0.0).select(weight * g, 0.0).sum();
}

}  // namespace gonio

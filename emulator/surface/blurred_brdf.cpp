#include "emulator/surface/blurred_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gonio {

using Eigen::ArrayXd;

BlurredBrdf::BlurredBrdf(std::shared_ptr<const MeasuredBrdf> brdf) : brdf_(std::move(brdf)) {}

void BlurredBrdf::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                           Eigen::Ref<Eigen::ArrayXXd> f_r) const {
  // Half of the direction itself and an eighth of each neighbour: 2 d^2 / 8 = step^2 / 6.
  const double theta_i = std::acos(std::min(omega_i.z(), 1.0));
  const double d = std::sqrt(2.0 / 3.0) * brdf_->step(radians(theta_i)).radians();
  brdf_->evaluate(omega_i, omega_r, f_r);
  f_r *= 0.5;
  // Along the meridian, and across it.
  const ArrayXd sine = (1.0 - omega_r.z.square()).max(0.0).sqrt();
  const ArrayXd cos_phi = (sine > 0.0).select(omega_r.x / sine, 1.0);
  const ArrayXd sin_phi = (sine > 0.0).select(omega_r.y / sine, 0.0);
  const DirectionBatch along{omega_r.z * cos_phi, omega_r.z * sin_phi, -sine};
  const DirectionBatch across{-sin_phi, cos_phi, ArrayXd::Zero(sine.size())};
  Eigen::ArrayXXd beside(f_r.rows(), f_r.cols());
  for (const DirectionBatch* axis : {&along, &across}) {
    for (const double by : {-d, d}) {
      const double c = std::cos(by);
      const double s = std::sin(by);
      brdf_->evaluate(omega_i,
                      {c * omega_r.x + s * axis->x, c * omega_r.y + s * axis->y,
                       c * omega_r.z + s * axis->z},
                      beside);
      f_r += 0.125 * beside;
    }
  }
}

}  // namespace gonio

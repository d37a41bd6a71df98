#include "emulator/surface/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gonio {

using Eigen::ArrayXd;

namespace {

DirectionBatch batch_of(const Vector3& omega) {
  return {.x = ArrayXd::Constant(1, omega.x()),
          .y = ArrayXd::Constant(1, omega.y()),
          .z = ArrayXd::Constant(1, omega.z())};
}

}  // namespace

ArrayXd Lobe::brdf(const Vector3& omega_i, const Vector3& omega_r) const {
  const DirectionBatch one = batch_of(omega_r);
  const ArrayXd s = colour(std::sqrt(std::max(0.0, 0.5 * (1.0 + omega_i.dot(omega_r)))));
  ArrayXd g(1);
  if (shape_parameter.size() == 0) {
    shape->evaluate(0.0, omega_i, one, g);
    return g(0) * s;
  }
  ArrayXd f_r(s.size());
  for (Eigen::Index l = 0; l < s.size(); ++l) {
    shape->evaluate(shape_parameter(l), omega_i, one, g);
    f_r(l) = g(0) * s(l);
  }
  return f_r;
}

ArrayXd MeasuredTerm::f_r(const Vector3& omega_i, const Vector3& omega_r) const {
  Eigen::ArrayXXd channels(1, spectra.rows());
  brdf->evaluate(omega_i, batch_of(omega_r), channels);
  return (channels.matrix() * spectra).transpose().array();
}

ArrayXd Surface::brdf(const Vector3& omega_i, const Vector3& omega_r) const {
  ArrayXd sum = ArrayXd::Zero(grid.size());
  for (const Lobe& lobe : lobes) {
    sum += lobe.brdf(omega_i, omega_r);
  }
  for (const MeasuredTerm& term : measured) {
    sum += term.f_r(omega_i, omega_r);
  }
  return sum;
}

ArrayXd Surface::specular_reflectance(double cos_theta_i) const {
  ArrayXd sum = ArrayXd::Zero(grid.size());
  for (const Interface& interface : interfaces) {
    sum += interface.colour(cos_theta_i);
  }
  return sum;
}

Surface polarised(const Surface& surface, double P) {
  if (!(P >= -1.0 && P <= 1.0)) {
    throw std::domain_error(fmt::format("polarised: P must be in [-1, 1], is {}", P));
  }
  Surface seen = surface;
  const auto favour = [P](auto& part) {
    if (part.difference && P != 0.0) {
      part.colour = [P, s = part.colour, d = part.difference](double cos_theta_d) -> ArrayXd {
        return s(cos_theta_d) + P * d(cos_theta_d);
      };
    }
  };
  std::ranges::for_each(seen.lobes, favour);
  std::ranges::for_each(seen.interfaces, favour);
  return seen;
}

void half_angle_cosine(const Vector3& omega_i, const DirectionBatch& omega_r,
                       Eigen::Ref<ArrayXd> cos_theta_d) {
  cos_theta_d =
      (0.5 * (1.0 + omega_i.x() * omega_r.x + omega_i.y() * omega_r.y + omega_i.z() * omega_r.z))
          .max(0.0)
          .sqrt();
}

}  // namespace gonio

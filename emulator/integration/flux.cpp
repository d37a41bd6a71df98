#include "emulator/integration/flux.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio {

CosineRange half_angle_range(const MeasuringGeometry& geometry) {
  const Vector3& i = geometry.source.frame().axis;
  const Vector3& r = geometry.receptor.frame().axis;
  const double between = std::atan2(i.cross(r).norm(), i.dot(r));
  // A hair more than the openings, so that the range is never empty.
  const double spread =
      geometry.source.radius().radians() + geometry.receptor.radius().radians() + 1e-6;
  return {.low = std::cos(0.5 * std::min(between + spread, std::numbers::pi)),
          .high = std::cos(0.5 * std::max(between - spread, 0.0))};
}

std::array<Aperture, 5> hemicube_faces() {
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  const auto side = [&](const Vector3& axis, const Vector3& along) {
    return Aperture::face({axis, along, z}, -1.0, 1.0, 0.0, 1.0);
  };
  return {Aperture::face({z, x, y}, -1.0, 1.0, -1.0, 1.0), side(x, y), side(-x, y), side(y, x),
          side(-y, x)};
}

Aperture collimated(const Vector3& omega) {
  const Vector3 u = omega.unitOrthogonal();
  return Aperture::face({omega, u, omega.cross(u)}, 0.0, 0.0, 0.0, 0.0);
}

}  // namespace gonio

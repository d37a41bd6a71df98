#include "emulator/optics/direction.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace gonio {

Vector3 Frame::direction(double u_coordinate, double v_coordinate) const {
  return (axis + u_coordinate * u + v_coordinate * v).normalized();
}

Frame Frame::turned_about_y(Angle angle) const {
  const Eigen::AngleAxisd turn(angle.radians(), Vector3::UnitY());
  return {turn * axis, turn * u, turn * v};
}

Frame receptor_frame(Angle theta) {
  const double c = std::cos(theta.radians());
  const double s = std::sin(theta.radians());
  return {{s, 0.0, c}, {c, 0.0, -s}, Vector3::UnitY()};
}

Frame source_frame(Angle theta) {
  const double c = std::cos(theta.radians());
  const double s = std::sin(theta.radians());
  return {{-s, 0.0, c}, {-c, 0.0, -s}, Vector3::UnitY()};
}

Frame mirrored(const Frame& frame) {
  return {mirrored(frame.axis), mirrored(frame.u), mirrored(frame.v)};
}

}  // namespace gonio

#include "emulator/measured/incidence_frame.hpp"

#include <cmath>

#include "emulator/measured/bracket.hpp"

namespace gonio {

IncidenceFrame::IncidenceFrame(const Vector3& omega_i) {
  const double sin_theta = std::hypot(omega_i.x(), omega_i.y());
  theta_i_ = std::atan2(sin_theta, omega_i.z());
  constexpr double no_azimuth = 1e-12;  // rounding leaves nothing of it
  if (sin_theta > no_azimuth) {
    cos_ = -omega_i.x() / sin_theta;
    sin_ = -omega_i.y() / sin_theta;
  }
}

double IncidenceFrame::rotation() const { return in_one_turn(std::atan2(sin_, cos_)); }

Vector3 local_incidence(double theta_i) { return {-std::sin(theta_i), 0.0, std::cos(theta_i)}; }

Vector3 moved_with_lobe(const Vector3& omega_r, double theta_i, double other_theta_i) {
  const Vector3 half = (local_incidence(theta_i) + omega_r).normalized();
  const Vector3 other = local_incidence(other_theta_i);
  return 2.0 * other.dot(half) * half - other;
}

}  // namespace gonio

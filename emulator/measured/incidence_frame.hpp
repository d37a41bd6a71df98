#pragma once

#include "emulator/optics/direction.hpp"

namespace gonio {

/// The plane of an incidence: in its coordinates light comes from azimuth pi, whatever its azimuth.
class IncidenceFrame {
 public:
  explicit IncidenceFrame(const Vector3& omega_i);

  [[nodiscard]] double theta_i() const { return theta_i_; }
  /// The azimuth of incidence from pi, in [0, 2 pi); 0 for light along the normal.
  [[nodiscard]] double rotation() const;
  /// The direction (x, y, z) in coordinates of the plane of incidence.
  [[nodiscard]] Vector3 local(double x, double y, double z) const {
    return {cos_ * x + sin_ * y, cos_ * y - sin_ * x, z};
  }

 private:
  double theta_i_, cos_ = 1.0, sin_ = 0.0;
};

/// Light from theta_i in the plane of an incidence. @param theta_i  [rad]
[[nodiscard]] Vector3 local_incidence(double theta_i);

/// Where the half vector of light from theta_i and a direction of reflection mirrors light from
/// another theta_i; all in the plane of incidence, which it stays in where it was.
[[nodiscard]] Vector3 moved_with_lobe(const Vector3& omega_r, double theta_i, double other_theta_i);

}  // namespace gonio

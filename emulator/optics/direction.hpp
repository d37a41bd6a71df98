#pragma once

#include <Eigen/Core>

#include "emulator/core/angle.hpp"

namespace gonio {

// The conventions of gonio, written here once:
//  - directions are unit vectors that point away from the surface, the incident one too;
//  - z is the normal of the sample, theta the polar angle from it, x-z the plane of measurement;
//  - the source stands at azimuth pi (x < 0), the receptor at azimuth 0 (x > 0);
//  - i is the incident, r the reflected direction, h their bisector, d the angle between i and h;
//  - an aperture is described in the plane tangent to the unit sphere at its axis, with
//    coordinates u (in the plane of measurement, growing with theta) and v (along y).

using Vector3 = Eigen::Vector3d;

/// Many directions, as a structure of arrays of one length.
struct DirectionBatch {
  Eigen::ArrayXd x, y, z;

  [[nodiscard]] Eigen::Index size() const { return x.size(); }
  void resize(Eigen::Index n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
};

/// An axis and the plane tangent to the unit sphere at it; right-angled unit vectors.
struct Frame {
  Vector3 axis, u, v;

  /// The direction through the point (u, v) of the tangent plane.
  [[nodiscard]] Vector3 direction(double u_coordinate, double v_coordinate) const;
  /// The frame turned by `angle` about the y axis, from z towards x: what a sample that is tilted
  /// by -angle sees.
  [[nodiscard]] Frame turned_about_y(Angle angle) const;
};

/// The frame of an axis in the plane of measurement.
/// @param theta  polar angle of the axis, in [-90 deg, 90 deg]; a negative one is past the normal.
[[nodiscard]] Frame source_frame(Angle theta);
[[nodiscard]] Frame receptor_frame(Angle theta);

/// The direction in which a smooth surface reflects light that comes from omega.
[[nodiscard]] inline Vector3 mirrored(const Vector3& omega) {
  return {-omega.x(), -omega.y(), omega.z()};
}

/// The frame that sees in the mirror what `frame` sees: its directions are mirrored one by one.
[[nodiscard]] Frame mirrored(const Frame& frame);

}  // namespace gonio

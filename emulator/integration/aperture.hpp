#pragma once

#include "emulator/core/angle.hpp"
#include "emulator/optics/direction.hpp"

namespace gonio {

/// A source image or a receptor as the sample sees it: a rectangle or a circle in the plane tangent
/// to the unit sphere at its axis. There, d omega = du dv / (1 + u^2 + v^2)^(3/2).
class Aperture {
 public:
  enum class Outline { rectangle, circle };

  /// @param in_plane, perpendicular  full angles, in [0, 120] deg; the half sizes are
  ///                                 tan(angle / 2). Zero makes a line, two zeros a direction.
  /// @throws std::domain_error  if an angle is outside its range.
  static Aperture rectangle(const Frame& frame, Angle in_plane, Angle perpendicular);
  /// A cone round the axis. @param diameter  full angle, in [0, 120] deg.
  static Aperture circle(const Frame& frame, Angle diameter);
  /// A rectangle by its edges in the tangent plane: the faces of a hemicube.
  static Aperture face(const Frame& frame, double u_low, double u_high, double v_low,
                       double v_high);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] Outline outline() const { return outline_; }
  [[nodiscard]] double u_low() const { return u_low_; }
  [[nodiscard]] double u_high() const { return u_high_; }
  [[nodiscard]] double v_low() const { return v_low_; }
  [[nodiscard]] double v_high() const { return v_high_; }
  /// No extent in one direction at least: the source is collimated in it.
  [[nodiscard]] bool is_degenerate() const { return u_low_ == u_high_ || v_low_ == v_high_; }

  /// Each direction within has its mirror image in the plane of measurement within.
  [[nodiscard]] bool is_symmetric() const;
  [[nodiscard]] bool contains(const Vector3& omega) const;
  /// [sr], in closed form; 0 if degenerate.
  [[nodiscard]] double solid_angle() const;
  /// The largest angle between the axis and a direction within.
  [[nodiscard]] Angle radius() const;
  /// The same circle, with u and v turned by 90 deg about the axis.
  [[nodiscard]] Aperture turned() const;
  /// The same opening seen in the mirror.
  [[nodiscard]] Aperture mirrored() const;
  /// The same opening seen by a sample tilted by `angle` in the plane of measurement.
  [[nodiscard]] Aperture seen_by_tilted(Angle angle) const;

 private:
  Aperture(const Frame& frame, Outline outline, double u_low, double u_high, double v_low,
           double v_high);
  Frame frame_;
  Outline outline_;
  double u_low_, u_high_, v_low_, v_high_;
};

/// The two apertures of a measurement, in the frame of the sample.
struct MeasuringGeometry {
  Aperture source;
  Aperture receptor;
};

}  // namespace gonio

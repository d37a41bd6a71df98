#include "emulator/integration/aperture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace gonio {

namespace {

double half_size(Angle full) {
  if (!(full.degrees() >= 0.0 && full.degrees() <= 120.0)) {
    throw std::domain_error("Aperture: an opening must be in [0, 120] deg, is " +
                            std::to_string(full.degrees()));
  }
  return std::tan(0.5 * full.radians());
}

/// Solid angle of the rectangle between the axis and the corner (u, v); odd in both.
double corner_solid_angle(double u, double v) {
  return std::atan2(u * v, std::sqrt(1.0 + u * u + v * v));
}

}  // namespace

Aperture::Aperture(const Frame& frame, Outline outline, double u_low, double u_high, double v_low,
                   double v_high)
    : frame_(frame),
      outline_(outline),
      u_low_(u_low),
      u_high_(u_high),
      v_low_(v_low),
      v_high_(v_high) {}

Aperture Aperture::rectangle(const Frame& frame, Angle in_plane, Angle perpendicular) {
  const double u = half_size(in_plane);
  const double v = half_size(perpendicular);
  return {frame, Outline::rectangle, -u, u, -v, v};
}

Aperture Aperture::circle(const Frame& frame, Angle diameter) {
  const double radius = half_size(diameter);
  const Outline outline = radius > 0.0 ? Outline::circle : Outline::rectangle;
  return {frame, outline, -radius, radius, -radius, radius};
}

Aperture Aperture::face(const Frame& frame, double u_low, double u_high, double v_low,
                        double v_high) {
  return {frame, Outline::rectangle, u_low, u_high, v_low, v_high};
}

bool Aperture::is_symmetric() const {
  return v_low_ == -v_high_ && frame_.axis.y() == 0.0 && frame_.u.y() == 0.0;
}

bool Aperture::contains(const Vector3& omega) const {
  const double along = omega.dot(frame_.axis);
  if (!(along > 0.0)) {
    return false;
  }
  const double u = omega.dot(frame_.u) / along;
  const double v = omega.dot(frame_.v) / along;
  if (outline_ == Outline::circle) {
    return u * u + v * v <= u_high_ * u_high_;
  }
  return u >= u_low_ && u <= u_high_ && v >= v_low_ && v <= v_high_;
}

double Aperture::solid_angle() const {
  if (outline_ == Outline::circle) {
    const double cos_radius = 1.0 / std::sqrt(1.0 + u_high_ * u_high_);
    return 2.0 * std::numbers::pi * u_high_ * u_high_ * cos_radius * cos_radius /
           (1.0 + cos_radius);
  }
  return corner_solid_angle(u_high_, v_high_) - corner_solid_angle(u_low_, v_high_) -
         corner_solid_angle(u_high_, v_low_) + corner_solid_angle(u_low_, v_low_);
}

Angle Aperture::radius() const {
  const double u = std::max(std::abs(u_low_), std::abs(u_high_));
  const double v = std::max(std::abs(v_low_), std::abs(v_high_));
  return radians(std::atan(outline_ == Outline::circle ? u : std::hypot(u, v)));
}

Aperture Aperture::turned() const {
  Aperture result = *this;
  result.frame_ = {frame_.axis, frame_.v, -frame_.u};
  return result;
}

Aperture Aperture::mirrored() const {
  Aperture result = *this;
  result.frame_ = gonio::mirrored(frame_);
  return result;
}

Aperture Aperture::seen_by_tilted(Angle angle) const {
  Aperture result = *this;
  result.frame_ = frame_.turned_about_y(-angle);
  return result;
}

}  // namespace gonio

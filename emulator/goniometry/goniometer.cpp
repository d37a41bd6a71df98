#include "emulator/goniometry/goniometer.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

constexpr double turn_deg = 360.0;

/// In [0, 360) deg, whole degrees without what their way through radians leaves.
double turned_deg(double azimuth_deg) {
  constexpr double per_deg = 1e9;
  const double rounded = std::round(azimuth_deg * per_deg) / per_deg;
  const double within = rounded - turn_deg * std::floor(rounded / turn_deg);
  return within < turn_deg ? within : 0.0;
}

struct Sines {
  double sine, cosine;
};

Sines sines_of(Angle azimuth) {
  const double within = turned_deg(azimuth.degrees());
  const double quarters = within / 90.0;
  if (quarters == std::floor(quarters)) {
    constexpr double at_quarter[] = {0.0, 1.0, 0.0, -1.0};
    const int quarter = int(quarters);
    return {at_quarter[quarter], at_quarter[(quarter + 1) % 4]};
  }
  return {std::sin(degrees(within).radians()), std::cos(degrees(within).radians())};
}

}  // namespace

Angle ScanPosition::azimuth_i() const {
  return degrees(turned_deg(0.5 * turn_deg - rotation.degrees()));
}

Angle ScanPosition::azimuth_r() const {
  const double past_normal = theta_r < Angle{} ? 0.5 * turn_deg : 0.0;
  return degrees(turned_deg(phi_r.degrees() + past_normal - rotation.degrees()));
}

Angle ScanPosition::between_heads() const {
  const Vector3 i = frame_towards(theta_i, degrees(0.5 * turn_deg)).axis;
  const Vector3 r = frame_towards(theta_r, phi_r).axis;
  return radians(std::atan2(i.cross(r).norm(), i.dot(r)));
}

Aperture ScanOpening::at(const Frame& frame) const {
  return outline == Aperture::Outline::circle ? Aperture::circle(frame, in_plane)
                                              : Aperture::rectangle(frame, in_plane, perpendicular);
}

Frame frame_towards(Angle theta, Angle azimuth) {
  const double c = std::cos(theta.radians());
  const double s = std::sin(theta.radians());
  const auto [sine, cosine] = sines_of(azimuth);
  return {{s * cosine, s * sine, c}, {c * cosine, c * sine, -s}, {-sine, cosine, 0.0}};
}

MeasuringGeometry scan_geometry(const ScanPosition& position, const ScanOpening& source,
                                const ScanOpening& receptor) {
  const Angle theta_r = radians(std::abs(position.theta_r.radians()));
  return {.source = source.at(frame_towards(position.theta_i, position.azimuth_i())),
          .receptor = receptor.at(frame_towards(theta_r, position.azimuth_r()))};
}

ScanPosition exchanged(const ScanPosition& position) {
  const double half = 0.5 * turn_deg;
  const double rotation = turned_deg(half - position.azimuth_r().degrees());
  return {.theta_i = radians(std::abs(position.theta_r.radians())),
          .theta_r = position.theta_i,
          .phi_r = degrees(turned_deg(position.azimuth_i().degrees() + rotation)),
          .rotation = degrees(rotation)};
}

}  // namespace gonio

#include "emulator/instrument/colorimeter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;

/// A direction of a beam, and its share of what falls on the sample.
struct Ray {
  Vector3 omega;
  double share;
};

/// Seven points of a disc, exact for polynomials of degree 5; of a rectangle, the same in the
/// ellipse that it would hold with as much variance along each axis.
/// @see Radon, Monatshefte fuer Mathematik 52, 286 (1948)
std::vector<Ray> rays_of(const Aperture& beam) {
  if (beam.is_degenerate() && beam.u_low() == beam.u_high() && beam.v_low() == beam.v_high()) {
    return {{.omega = beam.frame().axis, .share = 1.0}};
  }
  const bool is_circle = beam.outline() == Aperture::Outline::circle;
  const double stretch = is_circle ? 1.0 : std::sqrt(4.0 / 3.0);
  const double reach = stretch * std::sqrt(2.0 / 3.0);
  std::vector<Ray> rays;
  double sum = 0.0;
  const auto add = [&](double u, double v, double weight) {
    const Vector3 omega = beam.frame().direction(u, v);
    const double projected = weight * std::max(omega.z(), 0.0) / std::pow(1.0 + u * u + v * v, 1.5);
    sum += projected;
    rays.push_back({.omega = omega, .share = projected});
  };
  const double u_middle = 0.5 * (beam.u_low() + beam.u_high());
  const double v_middle = 0.5 * (beam.v_low() + beam.v_high());
  add(u_middle, v_middle, 0.25);
  for (int k = 0; k < 6; ++k) {
    const double phi = std::numbers::pi * k / 3.0;
    add(u_middle + 0.5 * (beam.u_high() - beam.u_low()) * reach * std::cos(phi),
        v_middle + 0.5 * (beam.v_high() - beam.v_low()) * reach * std::sin(phi), 0.125);
  }
  for (Ray& ray : rays) {
    ray.share /= sum;
  }
  return rays;
}

}  // namespace

Colorimeter::Colorimeter(Instrument instrument, const WavelengthGrid& grid,
                         std::shared_ptr<const FluxIntegrator> integrator, ArrayXd weight)
    : instrument_(std::move(instrument)),
      grid_(grid),
      integrator_(std::move(integrator)),
      weight_(std::move(weight)),
      diffuser_(lambertian(grid_, ArrayXd::Ones(grid_.size()))) {
  if (!instrument_.standard.scale.is_of_colour()) {
    throw std::invalid_argument(
        fmt::format("expected an instrument that measures colour, found '{}', which measures gloss "
                    "by {}: see gonio measure",
                    instrument_.id, instrument_.standard.id));
  }
}

Flux Colorimeter::collected(const Surface& surface, const std::string& geometry_id,
                            const MeasuringGeometry& geometry, double tolerance) const {
  if (!instrument_.standard.geometry(geometry_id).receptor.is_sphere) {
    return integrator_->reflected(surface, geometry, weight_, tolerance);
  }
  const double incident = integrator_->incident(geometry.source);
  Flux sum{.spectral = ArrayXd::Zero(grid_.size())};
  for (const Ray& ray : rays_of(geometry.source)) {
    const Flux flux =
        integrator_->hemispherical(surface, ray.omega, weight_, 0.5 * tolerance / incident);
    sum.spectral += incident * ray.share * flux.spectral;
    sum.error += incident * ray.share * flux.error;
  }
  if (!geometry.receptor.is_degenerate()) {
    const Flux trapped = integrator_->reflected(surface, geometry, weight_, 0.5 * tolerance);
    sum.spectral -= trapped.spectral;
    sum.error += trapped.error;
  }
  return sum;
}

ColourReading Colorimeter::read(const Surface& surface, const std::string& geometry_id,
                                double tolerance, Angle tilt) const {
  MeasuringGeometry geometry = instrument_.geometry(geometry_id);
  constexpr double share_of_reference = 0.01;
  const double incident = integrator_->incident(geometry.source);
  // The diffuser reflects pi sr times as evenly: of it the receptor sees about its solid angle /
  // pi.
  const bool is_sphere = instrument_.standard.geometry(geometry_id).receptor.is_sphere;
  const double seen =
      incident * (is_sphere ? 1.0 : geometry.receptor.solid_angle() / std::numbers::pi);
  const Flux reference =
      collected(diffuser_, geometry_id, geometry, share_of_reference * tolerance * seen);
  const double mean = (weight_ * reference.spectral).sum();
  if (!(mean > 0.0)) {
    throw InputError(instrument_.as_built.contains(geometry_id)
                         ? instrument_.as_built.at(geometry_id).mark
                         : instrument_.standard.geometry(geometry_id).mark,
                     "a receptor that sees light of a diffuser", "no light in it");
  }
  geometry.source = geometry.source.seen_by_tilted(tilt);
  geometry.receptor = geometry.receptor.seen_by_tilted(tilt);
  const Flux flux = collected(surface, geometry_id, geometry, tolerance * mean);
  const ArrayXd factor = flux.spectral / reference.spectral;
  return {.radiance_factor = factor,
          .quadrature_error = (flux.error + (weight_ * factor).sum() * reference.error) / mean};
}

std::optional<Angle> aspecular_angle(const GeometryLimits& limits) {
  if (limits.receptor.is_sphere) {
    return std::nullopt;
  }
  return radians(limits.theta_i.nominal.radians() - limits.receptor_angle().radians());
}

}  // namespace gonio

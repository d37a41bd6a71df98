#include "emulator/integration/aperture_integrator.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/chebyshev.hpp"
#include "emulator/integration/cubature.hpp"
#include "emulator/integration/lobe_flux.hpp"
#include "emulator/integration/measured_flux.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// Rounding of sums of up to a million terms of like sign, relative to the sum.
constexpr double rounding = 2e-14;

/// int over a region of cos i times the reflectance of smooth interfaces.
Flux interface_flux(const Colour& reflectance, const Region& region, const CosineRange& range,
                    const ArrayXd& weight, double tolerance) {
  constexpr int order = 5;
  std::size_t budget = 10'000;
  const ColourSeries series(reflectance, range.low, range.high, 0.02 * tolerance);
  const VectorXd functional = series.coefficient * weight.matrix();
  const SquareRule rule(region, order, order);
  CellNodes nodes;
  DirectionBatch omega;
  omega.resize(rule.size());
  ArrayXd control(rule.size());
  const auto estimate = [&](const Cell& cell) {
    nodes.place(region, cell, rule);
    ArrayXd& value = nodes.area;  // becomes cos i d omega_i, but for the weights of the rule
    kernel::tangent_directions(region.frame(), nodes.u, nodes.v, omega, value);
    const ArrayXd x = (series.scale * omega.z + series.shift).max(-1.0).min(1.0);
    kernel::chebyshev_series(functional, x, control);
    control *= value;
    CellEstimate result{.value = VectorXd::Zero(functional.size())};
    result.set_errors(rule, control);
    value *= rule.weight;
    kernel::add_chebyshev_moments(x, value, result.value);
    return result;
  };
  const Integral moments = integrate(region, region.corners(), {}, estimate, tolerance, budget);
  return {.spectral = (series.coefficient.transpose() * moments.value).array(),
          .error = moments.error + std::abs(moments.value(0)) * series.truncation.maxCoeff()};
}

/// The cosines of incidence within an aperture, or bounds on them.
CosineRange incidence_range(const Aperture& source) {
  const double theta = std::acos(std::clamp(source.frame().axis.z(), -1.0, 1.0));
  const double spread = source.radius().radians() + 1e-6;
  return {.low = std::max(std::cos(theta + spread), 0.0),
          .high = std::max(std::cos(std::max(theta - spread, 0.0)), 1e-6)};
}

}  // namespace

Flux ApertureIntegrator::reflected(const Surface& surface, const MeasuringGeometry& geometry,
                                   const ArrayXd& weight, double tolerance) const {
  const double terms = double(surface.lobes.size() + surface.measured.size()) +
                       (surface.interfaces.empty() ? 0.0 : 1.0);
  const double share = tolerance / std::max(terms, 1.0);
  Flux sum{.spectral = ArrayXd::Zero(surface.grid.size())};
  const auto add = [&](const Flux& flux) {
    sum.spectral += flux.spectral;
    sum.error += flux.error + rounding * (weight * flux.spectral).sum();
  };
  if (!surface.interfaces.empty()) {
    const Region overlap(geometry.source, geometry.receptor.mirrored());
    add(interface_flux([&](double c) { return surface.specular_reflectance(c); }, overlap,
                       incidence_range(geometry.source), weight, share));
  }
  const double incoming = incident(geometry.source);
  for (const Lobe& lobe : surface.lobes) {
    if (incoming > 0.0) {
      add(LobeFlux(lobe, geometry, weight, share, incoming)());
    }
  }
  for (const MeasuredTerm& term : surface.measured) {
    if (incoming > 0.0) {
      add(measured_flux(term, geometry, weight, share, incoming));
    }
  }
  return sum;
}

double ApertureIntegrator::incident(const Aperture& source) const {
  constexpr double tolerance = 1e-16;
  return interface_flux([](double) -> ArrayXd { return ArrayXd::Ones(1); }, Region(source),
                        incidence_range(source), ArrayXd::Ones(1), tolerance)
      .spectral(0);
}

Flux ApertureIntegrator::hemispherical(const Surface& surface, const Vector3& omega_i,
                                       const ArrayXd& weight, double tolerance) const {
  Surface lobes = surface;
  lobes.interfaces.clear();
  Flux sum{.spectral = surface.specular_reflectance(omega_i.z())};
  const auto faces = hemicube_faces();
  for (const Aperture& face : faces) {
    const Flux flux = reflected(lobes, {collimated(omega_i), face}, weight,
                                tolerance * omega_i.z() / double(faces.size()));
    sum.spectral += flux.spectral / omega_i.z();
    sum.error += flux.error / omega_i.z();
  }
  return sum;
}

}  // namespace gonio

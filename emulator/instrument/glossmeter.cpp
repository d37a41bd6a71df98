#include "emulator/instrument/glossmeter.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "emulator/optics/fresnel.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;

/// The reference is integrated to this accuracy, relative to the incident flux: it costs little.
constexpr double reference_tolerance = 1e-13;

}  // namespace

Glossmeter::Glossmeter(Instrument instrument, const WavelengthGrid& grid,
                       std::shared_ptr<const FluxIntegrator> integrator,
                       const ArrayXcd& reference_index)
    : instrument_(std::move(instrument)),
      grid_(grid),
      integrator_(std::move(integrator)),
      source_(instrument_.source.sample(grid)),
      weight_(source_ * instrument_.responsivity.sample(grid)) {
  expect_gloss(instrument_);
  if (weight_.minCoeff() < 0.0 || !(weight_.sum() > 0.0)) {
    throw InputError(instrument_.source.mark(),
                     "power where the receptor responds, nowhere below 0", "none or less");
  }
  weight_ /= weight_.sum();
  const Scale& scale = instrument_.standard.scale;
  if (scale.reference == Scale::Reference::glass) {
    reference_ =
        smooth(grid_, reference_index.size() > 0
                          ? reference_index
                          : ArrayXcd::Constant(grid_.size(), scale.refractive_index->nominal));
  }
}

Flux Glossmeter::reflected(const Surface& surface, const std::string& geometry_id,
                           const MeasuringGeometry& geometry, double tolerance) const {
  const auto found = instrument_.polarization.find(geometry_id);
  if (found == instrument_.polarization.end() || found->second == 0.0) {
    return integrator_->reflected(surface, geometry, weight_, tolerance);
  }
  return integrator_->reflected(polarised(surface, found->second), geometry, weight_, tolerance);
}

Flux Glossmeter::reference_flux(const std::string& geometry_id) const {
  const std::string at =
      instrument_.standard.geometry(geometry_id).relative_to.value_or(geometry_id);
  const MeasuringGeometry geometry = instrument_.geometry(at);
  const double incident = integrator_->incident(geometry.source);
  if (!reference_) {
    return {.spectral = ArrayXd::Constant(grid_.size(), incident)};
  }
  return reflected(*reference_, at, geometry, reference_tolerance * incident);
}

GlossReading Glossmeter::read(const Surface& surface, const std::string& geometry_id,
                              double tolerance, Angle tilt) const {
  MeasuringGeometry geometry = instrument_.geometry(geometry_id);
  const double incident = integrator_->incident(geometry.source);
  const Flux reference = reference_flux(geometry_id);
  const double reference_luminous = (weight_ * reference.spectral).sum();
  if (!(reference_luminous > 0.0)) {
    throw InputError(instrument_.as_built.contains(geometry_id)
                         ? instrument_.as_built.at(geometry_id).mark
                         : instrument_.standard.geometry(geometry_id).mark,
                     "a receptor that the image of the source reaches", "no light in it");
  }
  geometry.source = geometry.source.seen_by_tilted(tilt);
  geometry.receptor = geometry.receptor.seen_by_tilted(tilt);
  const double gloss_per_flux = instrument_.standard.scale.value.nominal / reference_luminous;
  const Flux flux = reflected(surface, geometry_id, geometry, tolerance / gloss_per_flux);
  const double luminous = (weight_ * flux.spectral).sum();
  return {.gloss = gloss_per_flux * luminous,
          .quadrature_error =
              gloss_per_flux * (flux.error + luminous / reference_luminous * reference.error),
          .luminous_reflectance = luminous / incident,
          .reflectance = flux.spectral / incident};
}

double assigned_gloss(double n, Angle theta_i, const Scale& scale) {
  const double cos_theta_i = std::cos(theta_i.radians());
  const double reference = scale.refractive_index
                               ? fresnel_reflectance(cos_theta_i, scale.refractive_index->nominal)
                               : 1.0;
  return scale.value.nominal * fresnel_reflectance(cos_theta_i, n) / reference;
}

}  // namespace gonio

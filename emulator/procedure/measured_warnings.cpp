#include "emulator/procedure/measured_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "emulator/surface/blurred_brdf.hpp"

namespace gonio {

namespace {

/// The largest polar angle of an aperture for a sample tilted towards the receptor.
Angle largest_theta(const Aperture& aperture, Angle tilt) {
  const Vector3 axis = aperture.seen_by_tilted(tilt).frame().axis;
  return radians(std::acos(std::clamp(axis.z(), -1.0, 1.0)) + aperture.radius().radians());
}

bool is_by_wavelength(const MeasuredTerm& term) {
  return term.brdf->channels().front().band == BrdfChannel::Band::wavelength;
}

}  // namespace

double resolution_error_gu(const Surface& surface, const Glossmeter& glossmeter,
                           const std::string& geometry_id, const GlossReading& reading,
                           Angle tilt) {
  if (surface.measured.empty()) {
    return 0.0;
  }
  constexpr double accuracy = 0.003;  // of the reading: better than an estimate needs
  constexpr double least_gu = 1e-3;
  Surface blurred = surface;
  for (MeasuredTerm& term : blurred.measured) {
    term.brdf = std::make_shared<BlurredBrdf>(term.brdf);
  }
  const double tolerance = std::max(accuracy * reading.gloss, least_gu);
  return std::abs(glossmeter.read(blurred, geometry_id, tolerance, tilt).gloss - reading.gloss);
}

std::vector<std::string> data_warnings(const Surface& surface) {
  std::vector<std::string> warnings;
  for (const MeasuredTerm& term : surface.measured) {
    warnings.insert(warnings.end(), term.warnings.begin(), term.warnings.end());
    if (!is_by_wavelength(term)) {
      continue;
    }
    const double first = term.brdf->channels().front().wavelength->nanometres();
    const double last = term.brdf->channels().back().wavelength->nanometres();
    if (first > surface.grid.first().nanometres() || last < surface.grid.last().nanometres()) {
      warnings.push_back(
          fmt::format("the BRDF was measured from {:g} nm to {:g} nm; beyond, it is held constant",
                      first, last));
    }
  }
  return warnings;
}

std::vector<std::string> reading_warnings(const Surface& surface, const Glossmeter& glossmeter,
                                          const std::string& geometry_id,
                                          const GlossReading& reading, Angle tilt) {
  constexpr double relative = 0.01;  // below both, nobody would see it on a glossmeter
  constexpr double absolute_gu = 0.05;
  std::vector<std::string> warnings;
  if (surface.measured.empty()) {
    return warnings;
  }
  const MeasuringGeometry geometry = glossmeter.instrument().geometry(geometry_id);
  const Angle theta_i = glossmeter.instrument().angle_of_incidence(geometry_id);
  const double error_gu = resolution_error_gu(surface, glossmeter, geometry_id, reading, tilt);
  double step_deg = 0.0;
  double measured_deg = 90.0;
  for (const MeasuredTerm& term : surface.measured) {
    step_deg = std::max(step_deg, term.brdf->step(theta_i).degrees());
    measured_deg = std::min(measured_deg, term.brdf->largest_theta().degrees());
  }
  if (error_gu > std::max(relative * std::abs(reading.gloss), absolute_gu)) {
    warnings.push_back(fmt::format(
        "at {}: the BRDF was measured in steps of {:.2g} deg, coarse for the lobe it shows: the "
        "gloss may be off by about {:.2g}",
        geometry_id, step_deg, error_gu));
  }
  const double needed_deg = std::max(largest_theta(geometry.source, tilt).degrees(),
                                     largest_theta(geometry.receptor, tilt).degrees());
  if (needed_deg > measured_deg) {
    warnings.push_back(fmt::format(
        "at {}: directions up to {:.3g} deg count, the BRDF was measured up to {:.3g} deg: what is "
        "beyond is guessed",
        geometry_id, std::min(needed_deg, 90.0), measured_deg));
  }
  return warnings;
}

}  // namespace gonio

#include "emulator/goniometry/scan_samples.hpp"

#include <fmt/format.h>

#include <cmath>

#include "emulator/core/unit_value.hpp"

namespace gonio {

using Eigen::Index;

std::string opening_words(const ScanOpening& opening) {
  if (opening.is_collimated()) {
    return "collimated";
  }
  return opening.outline == Aperture::Outline::circle
             ? fmt::format("circle {:g} deg", stated_degrees(opening.in_plane))
             : fmt::format("rectangle {:g} deg x {:g} deg", stated_degrees(opening.in_plane),
                           stated_degrees(opening.perpendicular));
}

std::string integrator_words(const ScanPlan& plan) {
  return plan.integrator == ScanIntegrator::aperture
             ? "aperture"
             : fmt::format("patches, {} on the hemisphere", 3L * plan.patches * plan.patches);
}

double solid_angle(const ScanOpening& opening) {
  return opening.at(receptor_frame({})).solid_angle();
}

BrdfSamples brdf_samples(const ScanResult& result, const ScanPlan& plan,
                         const std::string& sample_id) {
  BrdfSamples samples;
  samples.notes = {
      {"SAMPLE_NAME", sample_id},
      {"SYSTEM_NAME", "gonio scan"},
      {"MEAS_NAME", plan.id},
      {"SOURCE_APERTURE", opening_words(plan.source)},
      {"RECEIVER_APERTURE", opening_words(plan.receptor)},
      {"RECEIVER_SOLID_ANGLE", fmt::format("{} sr", solid_angle(plan.receptor))},
      {"SOURCE_SPECTRUM", plan.spectrum.empty() ? "D65" : plan.spectrum.filename().string()},
      {"INTEGRATOR", integrator_words(plan)},
      {"TOLERANCE", fmt::format("{}", plan.tolerance)}};
  for (Index l = 0; l < plan.grid.size(); ++l) {
    samples.channels.push_back({.band = BrdfChannel::Band::wavelength,
                                .wavelength = nanometres(plan.grid.nanometres()(l))});
  }
  std::vector<Index> known;
  for (Index p = 0; p < result.size(); ++p) {
    if (result.state[std::size_t(p)] != PositionState::blocked) {
      known.push_back(p);
    }
  }
  const auto n = Index(known.size());
  for (auto* angles : {&samples.theta_i, &samples.phi_i, &samples.theta_r, &samples.phi_r}) {
    angles->resize(n);
  }
  samples.f_r.resize(n, plan.grid.size());
  for (Index k = 0; k < n; ++k) {
    const ScanPosition& position = result.positions[std::size_t(known[std::size_t(k)])];
    samples.theta_i(k) = position.theta_i.radians();
    samples.phi_i(k) = position.azimuth_i().radians();
    samples.theta_r(k) = std::abs(position.theta_r.radians());
    samples.phi_r(k) = position.azimuth_r().radians();
    samples.f_r.row(k) = result.f_r.col(known[std::size_t(k)]).transpose();
  }
  return samples;
}

}  // namespace gonio

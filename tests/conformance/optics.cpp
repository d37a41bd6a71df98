// What stands beside the verdicts of a set-up: its effects in gloss units, and its pictures.
#include <algorithm>

#include "emulator/procedure/footprint.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "emulator/surface/models.hpp"
#include "tests/conformance/run.hpp"

namespace gonio::conformance {

namespace {

constexpr double tolerance_gu = 1e-4;

WeightingCurve curve_of(const std::string& title, const SpectralTable& source,
                        const SpectralTable& responsivity) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  Eigen::ArrayXd weight = source.sample(grid) * responsivity.sample(grid);
  weight /= weight.sum();
  WeightingCurve curve{.title = title, .wavelength_nm = {}, .weight = {}};
  for (Eigen::Index j = 0; j < grid.size(); ++j) {
    curve.wavelength_nm.push_back(grid.nanometres()[j]);
    curve.weight.push_back(weight[j]);
  }
  return curve;
}

/// The semi-gloss paint whose lobe is as wide as receptors are.
Sample pictured_sample() {
  const WavelengthGrid grid = WavelengthGrid::visible();
  return {.file = {},
          .id = "semi_gloss",
          .title = "Cook-Torrance, m = 0.05, n = 1.5",
          .surface = cook_torrance(grid, 0.05, Eigen::ArrayXcd::Constant(grid.size(), 1.5))};
}

/// The effects of the quantities that a clause limits.
void attach(const SetupEffects& effects, ConformanceReport& report) {
  const std::string quantity = setup_quantity_names[std::size_t(effects.quantity)];
  for (ClauseResult& clause : report.clauses) {
    const bool limits_it =
        std::any_of(clause.limits.begin(), clause.limits.end(), [&](const LimitRow& limit) {
          return limit.quantity == quantity && limit.geometry == effects.geometry;
        });
    if (limits_it) {
      clause.effects.push_back(effects);
    }
  }
}

}  // namespace

void add_optics(ConformanceReport& report, const ConformanceSuite& suite,
                const DeviceUnderTest& device) {
  if (!suite.set.standard || !device.instrument) {
    return;
  }
  const Standard& standard = *suite.set.standard;
  report.weightings.push_back(curve_of(standard.id, standard.source, standard.responsivity));
  const Instrument& instrument = *device.instrument;
  if (device.is_spectrum_known) {
    report.weightings.push_back(curve_of("device", instrument.source, instrument.responsivity));
  }
  const std::vector<Sample> ladder = effect_ladder(WavelengthGrid::visible());
  for (const std::string& geometry : instrument.geometries) {
    try {
      for (const SetupEffects& effects :
           setup_effects(instrument, geometry, ladder, tolerance_gu)) {
        attach(effects, report);
      }
      report.footprints.push_back(footprint(instrument, geometry, pictured_sample()));
    } catch (const InputError&) {
      continue;  // an aperture of unknown size has neither
    }
  }
}

}  // namespace gonio::conformance

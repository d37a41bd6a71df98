#include "emulator/procedure/setup_effects.hpp"

#include <algorithm>
#include <array>
#include <complex>
#include <memory>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;

/// Constant indices: geometry does not ask for dispersion.
constexpr std::complex<double> paint(1.5, 0.0);
constexpr std::complex<double> glass(1.567, 0.0);
constexpr std::complex<double> copper(1.0, 2.6);      // near 550 nm
constexpr std::complex<double> aluminium(0.96, 6.7);  // near 550 nm

/// A red pigment: the reflectance rises from 0.05 to 0.8 round 590 nm.
ArrayXd red(const WavelengthGrid& grid) {
  return 0.05 + 0.75 / (1.0 + (-(grid.nanometres() - 590.0) / 10.0).exp());
}

/// The set-up of which one quantity at a time is changed: nominal values, and openings as built
/// where the standard leaves their size unknown.
Instrument nominal_setup(const Instrument& instrument, const std::string& geometry_id) {
  Instrument nominal = nominal_instrument(instrument.standard);
  const GeometryLimits& limits = nominal.standard.geometry(geometry_id);
  const auto found = instrument.as_built.find(geometry_id);
  if (found == instrument.as_built.end() ||
      (limits.source.is_known() && limits.receptor.is_known())) {
    return nominal;
  }
  GeometryAsBuilt& base = nominal.as_built[geometry_id];
  base.mark = limits.mark;
  if (!limits.source.is_known()) {
    base.source = found->second.source;
  }
  if (!limits.receptor.is_known()) {
    base.receptor = found->second.receptor;
  }
  return nominal;
}

/// A quantity that the standard limits, and the values at which its effect is read.
struct Study {
  SetupQuantity quantity;
  Angle nominal;
  std::array<Angle, 3> values;  ///< as built, low, high
};

std::vector<Study> studies_of(const Instrument& instrument, const Instrument& nominal,
                              const std::string& geometry_id) {
  const GeometryLimits& limits = nominal.standard.geometry(geometry_id);
  std::vector<Study> studies;
  for (std::size_t i = 0; i < setup_quantity_count; ++i) {
    const auto quantity = SetupQuantity(i);
    const Stated<Angle>* limit = limit_of(limits, quantity);
    if (limit == nullptr || !limit->tolerance || !as_built(nominal, geometry_id, quantity)) {
      continue;
    }
    const Angle at = limit->nominal;
    const auto built = as_built(instrument, geometry_id, quantity);
    studies.push_back(
        {.quantity = quantity,
         .nominal = at,
         .values = {built ? built->value : at, std::max(at - *limit->tolerance, Angle()),
                    at + *limit->tolerance}});
  }
  return studies;
}

/// Readings of all samples of a ladder by many set-ups that differ in one geometry.
class Readings {
 public:
  Readings(const std::vector<Sample>& ladder, std::string geometry_id, double tolerance)
      : ladder_(ladder), geometry_id_(std::move(geometry_id)), tolerance_(tolerance) {}

  /// @return  the column of that set-up.
  std::size_t add(const Instrument& setup) {
    meters_.emplace_back(setup, ladder_.front().surface.grid, integrator_);
    return meters_.size() - 1;
  }

  void read_all() {
    gloss_gu_.resize(meters_.size() * ladder_.size());
    parallel_for(gloss_gu_.size(), [&](std::size_t i) {
      const Sample& sample = ladder_[i % ladder_.size()];
      gloss_gu_[i] = meters_[i / ladder_.size()]
                         .read(sample.surface, geometry_id_, tolerance_, sample.tilt)
                         .gloss;
    });
  }

  /// How each sample reads by the set-ups of these columns.
  [[nodiscard]] std::vector<LadderRow> rows(std::size_t nominal, std::size_t as_built,
                                            std::size_t low, std::size_t high) const {
    std::vector<LadderRow> result;
    for (std::size_t s = 0; s < ladder_.size(); ++s) {
      const auto at = [&](std::size_t setup) { return gloss_gu_[setup * ladder_.size() + s]; };
      result.push_back({.sample = ladder_[s].id,
                        .title = ladder_[s].title,
                        .nominal_gu = at(nominal),
                        .as_built_gu = at(as_built) - at(nominal),
                        .low_gu = at(low) - at(nominal),
                        .high_gu = at(high) - at(nominal)});
    }
    return result;
  }

 private:
  const std::vector<Sample>& ladder_;
  std::string geometry_id_;
  double tolerance_;
  std::shared_ptr<const FluxIntegrator> integrator_ = std::make_shared<ApertureIntegrator>();
  std::vector<Glossmeter> meters_;
  std::vector<double> gloss_gu_;
};

}  // namespace

std::vector<Sample> effect_ladder(const WavelengthGrid& grid) {
  const auto rough = [&](double rms_slope, std::complex<double> n_hat) {
    return cook_torrance(grid, rms_slope, ArrayXcd::Constant(grid.size(), n_hat));
  };
  const auto polished = [&](std::complex<double> n_hat) {
    return smooth(grid, ArrayXcd::Constant(grid.size(), n_hat));
  };
  std::vector<Sample> ladder;
  const auto add = [&](const char* id, const char* title, Surface surface) {
    ladder.push_back({.file = {}, .id = id, .title = title, .surface = std::move(surface)});
  };
  add("paint_m300", "Black paint, n = 1.5, slope 0.3", rough(0.3, paint));
  add("white_diffuser", "White diffuser", lambertian(grid, ArrayXd::Ones(grid.size())));
  add("paint_m150", "Black paint, n = 1.5, slope 0.15", rough(0.15, paint));
  add("red_paint_m150", "Red paint, n = 1.5, slope 0.15",
      coated(grid, red(grid), ArrayXd::Constant(grid.size(), paint.real()), 0.15));
  add("glass_m100", "Black glass, n = 1.567, slope 0.1", rough(0.1, glass));
  add("glass_m050", "Black glass, n = 1.567, slope 0.05", rough(0.05, glass));
  add("aluminium_m200", "Blasted aluminium, slope 0.2", rough(0.2, aluminium));
  add("glass_m030", "Black glass, n = 1.567, slope 0.03", rough(0.03, glass));
  add("glass_m020", "Black glass, n = 1.567, slope 0.02", rough(0.02, glass));
  add("paint_smooth", "Black paint, n = 1.5, smooth", polished(paint));
  add("copper_m065", "Copper, slope 0.065", rough(0.065, copper));
  add("aluminium_smooth", "Aluminium, smooth", polished(aluminium));
  add("ideal_mirror", "Ideal mirror", smooth(grid, 1.0));
  return ladder;
}

std::vector<SetupEffects> setup_effects(const Instrument& instrument,
                                        const std::string& geometry_id,
                                        const std::vector<Sample>& ladder, double tolerance) {
  const Instrument nominal = nominal_setup(instrument, geometry_id);
  const std::vector<Study> studies = studies_of(instrument, nominal, geometry_id);
  if (ladder.empty() || studies.empty()) {
    return {};
  }
  Readings readings(ladder, geometry_id, tolerance);
  const std::size_t as_nominal = readings.add(nominal);
  std::vector<std::array<std::size_t, 3>> columns;  // for each study
  for (const Study& study : studies) {
    auto& column = columns.emplace_back();
    std::ranges::transform(study.values, column.begin(), [&](Angle value) {
      return value == study.nominal
                 ? as_nominal
                 : readings.add(with_quantity(nominal, geometry_id, study.quantity, {value}));
    });
  }
  readings.read_all();
  std::vector<SetupEffects> effects;
  for (std::size_t q = 0; q < studies.size(); ++q) {
    const auto [as_built, low, high] = studies[q].values;
    const auto& column = columns[q];
    effects.push_back({.geometry = geometry_id,
                       .quantity = studies[q].quantity,
                       .nominal = studies[q].nominal,
                       .as_built = as_built,
                       .low = low,
                       .high = high,
                       .rows = readings.rows(as_nominal, column[0], column[1], column[2])});
  }
  return effects;
}

}  // namespace gonio

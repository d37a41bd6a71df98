#include "emulator/procedure/deviation_effects.hpp"

#include <algorithm>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/core/unit_value.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Components = std::array<double, uncertainty_component_count>;

/// A set-up of which a reading is wanted.
struct Setting {
  VectorXd parameters;  // of the optics
  bool has_standard_spectra = true;
  Components components = {};
  double contamination = 0.0;  // of the tile
};

class Effects {
 public:
  Effects(const Instrument& instrument, const GeometryLimits& limits, const OpticalResponse& optics,
          const MeasurementEquation& equation)
      : instrument_(instrument), limits_(limits), optics_(optics), equation_(equation) {}

  std::vector<DeviationEffect> operator()() {
    all_ = nominal();
    for (std::size_t i = 0; i < optics_.quantities().size(); ++i) {
      add_quantity(i);
    }
    add_polarization();
    add_spectrum();
    add_linearity();
    add_contamination();
    add({.component = "all"}, all_);
    read_all();
    return std::move(effects_);
  }

 private:
  /// Where the readings of a setting go.
  enum class Column { as_built, low, high };
  struct Job {
    Setting setting;
    std::size_t effect;
    Column column;
  };

  [[nodiscard]] Setting nominal() const {
    return {.parameters = optics_.nominal(), .components = {}};
  }

  void add(DeviationEffect effect, const Setting& as_built) {
    effect.geometry = limits_.id;
    effects_.push_back(std::move(effect));
    jobs_.push_back({as_built, effects_.size() - 1, Column::as_built});
  }

  void add_quantity(std::size_t i) {
    const SetupQuantity quantity = optics_.quantities()[i];
    const auto at = Index(i);
    const double nominal_deg = optics_.nominal()[at];
    const double as_built_deg = optics_.as_built()[at];
    Setting built = nominal();
    built.parameters[at] = all_.parameters[at] = as_built_deg;
    add({.component = setup_quantity_names[std::size_t(quantity)],
         .unit = "deg",
         .nominal = nominal_deg,
         .as_built = as_built_deg},
        built);
    const Stated<Angle>* limit = limit_of(limits_, quantity);
    if (limit == nullptr || !limit->tolerance) {
      return;
    }
    const double tolerance = stated_degrees(*limit->tolerance);
    DeviationEffect& effect = effects_.back();
    effect.low = std::max(nominal_deg - tolerance, 0.0);
    effect.high = nominal_deg + tolerance;
    Setting at_limit = nominal();
    at_limit.parameters[at] = *effect.low;
    jobs_.push_back({at_limit, effects_.size() - 1, Column::low});
    at_limit.parameters[at] = *effect.high;
    jobs_.push_back({at_limit, effects_.size() - 1, Column::high});
  }

  void add_polarization() {
    const Index at = optics_.size() - 2;
    Setting built = nominal();
    built.parameters[at] = all_.parameters[at] = optics_.as_built()[at];
    add({.component = "polarization", .nominal = 0.0, .as_built = optics_.as_built()[at]}, built);
  }

  void add_spectrum() {
    Setting built = nominal();
    built.has_standard_spectra = all_.has_standard_spectra = false;
    add({.component = "spectrum"}, built);
  }

  void add_linearity() {
    Setting built = nominal();
    const auto component = std::size_t(UncertaintyComponent::linearity);
    built.components[component] = all_.components[component] = instrument_.behaviour.linearity;
    add({.component = "linearity", .nominal = 0.0, .as_built = instrument_.behaviour.linearity},
        built);
  }

  void add_contamination() {
    Setting built = nominal();
    built.contamination = all_.contamination = instrument_.behaviour.tile_contamination;
    add({.component = "tile_contamination",
         .nominal = 0.0,
         .as_built = instrument_.behaviour.tile_contamination},
        built);
  }

  [[nodiscard]] VectorXd read(const Setting& setting) const {
    const VectorXd g = setting.has_standard_spectra
                           ? optics_.with_standard_spectra(setting.parameters)
                           : optics_(setting.parameters);
    MeasurementEquation equation = equation_;
    equation.tile_contamination = setting.contamination;
    return g.unaryExpr(
        [&](double optical) { return equation.reading(optical, setting.components); });
  }

  void read_all() {
    std::vector<VectorXd> readings(jobs_.size());
    VectorXd base;
    parallel_for(jobs_.size() + 1, [&](std::size_t i) {
      (i < jobs_.size() ? readings[i] : base) =
          read(i < jobs_.size() ? jobs_[i].setting : nominal());
    });
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const VectorXd change = readings[i] - base;
      DeviationEffect& effect = effects_[jobs_[i].effect];
      std::vector<double>& column = jobs_[i].column == Column::low    ? effect.low_gu
                                    : jobs_[i].column == Column::high ? effect.high_gu
                                                                      : effect.as_built_gu;
      column.assign(change.begin(), change.end());
    }
  }

  const Instrument& instrument_;
  const GeometryLimits& limits_;
  const OpticalResponse& optics_;
  const MeasurementEquation& equation_;
  Setting all_;
  std::vector<DeviationEffect> effects_ = {};
  std::vector<Job> jobs_ = {};
};

}  // namespace

std::vector<DeviationEffect> deviation_effects(const Instrument& instrument,
                                               const GeometryLimits& limits,
                                               const OpticalResponse& optics,
                                               const MeasurementEquation& equation) {
  return Effects(instrument, limits, optics, equation)();
}

}  // namespace gonio

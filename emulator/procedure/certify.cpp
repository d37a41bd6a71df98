#include "emulator/procedure/certify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "emulator/instrument/signal.hpp"
#include "emulator/procedure/deviation_effects.hpp"
#include "emulator/procedure/reading_model.hpp"
#include "emulator/procedure/setup_limits.hpp"
#include "emulator/procedure/worst_case.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Both methods agree if neither their U nor their estimates differ by more, relative to U: a
/// twentieth does not change the second digit of U by more than a unit or two.
constexpr double agreement = 0.05;
/// Where Monte Carlo has to go through the optics, which cost a thousand times as much: two blocks.
constexpr std::size_t most_direct_trials = 20'000;

std::vector<std::string> geometries_of(const Instrument& instrument,
                                       const std::vector<std::string>& asked) {
  for (const std::string& id : asked) {
    if (!instrument.has(id)) {
      throw std::invalid_argument(
          fmt::format("certify: expected geometries of {}, found '{}'", instrument.id, id));
    }
  }
  std::vector<std::string> ids;
  for (const std::string& id : instrument.geometries) {
    if (asked.empty() || std::ranges::find(asked, id) != asked.end()) {
      ids.push_back(id);
    }
  }
  return ids;
}

std::vector<CertificateInput> described(const UncertaintyInputs& inputs) {
  std::vector<CertificateInput> result;
  for (const InputQuantity& input : inputs.set.inputs()) {
    result.push_back({.id = input.id,
                      .component = input.id,
                      .geometry = {},
                      .unit = {},
                      .estimate = input.estimate,
                      .distribution = input.distribution});
  }
  const auto describe = [&](std::size_t place, const GeometryInputs& geometry, const char* name,
                            const char* unit) {
    CertificateInput& input = result[place];
    if (input.id != name) {  // else of all geometries
      input.geometry = geometry.geometry;
    }
    input.component = name;
    input.unit = unit;
  };
  for (const GeometryInputs& geometry : inputs.geometries) {
    for (std::size_t i = 0; i < geometry.setup.size(); ++i) {
      describe(geometry.setup_index[i], geometry,
               setup_quantity_names[std::size_t(geometry.setup[i])], "deg");
    }
    for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
      describe(geometry.component_index[i], geometry, uncertainty_component_names[i],
               uncertainty_component_units[i]);
    }
  }
  return result;
}

/// What each sample reads before the instrument was calibrated: by the factory's gain, at the end
/// of an interval of calibration, the stray light not taken off.
double before_adjustment(const Instrument& instrument, const std::string& geometry_id,
                         double optical_gu) {
  const Behaviour& b = instrument.behaviour;
  const auto channel =
      std::ranges::find(instrument.geometries, geometry_id) - instrument.geometries.begin();
  return clean_signal_gu(b, std::size_t(channel), optical_gu, b.stray_light_gu,
                         b.warm_up_s + b.calibration_interval_s);
}

class Certification {
 public:
  Certification(const Instrument& instrument, const std::vector<Sample>& ladder,
                const CertifyOptions& options, Certificate& certificate)
      : instrument_(instrument), ladder_(ladder), options_(options), certificate_(certificate) {}

  void run(const std::vector<std::string>& ids) {
    const UncertaintyInputs inputs = uncertainty_inputs(instrument_, ids);
    certificate_.inputs = described(inputs);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      models_.push_back(std::make_unique<ReadingModel>(
          instrument_, inputs.set, inputs.geometries[i], ladder_, options_.tolerance));
      certificate_.geometries.push_back(geometry(inputs.set, *models_.back()));
      if (options_.advance) {
        options_.advance("geometries", i + 1, ids.size());
      }
    }
    run_monte_carlo(inputs.set);
    run_directly(inputs.set);
  }

 private:
  [[nodiscard]] GeometryCertificate geometry(const InputSet& set, ReadingModel& model) const {
    const std::string& id = model.inputs().geometry;
    const GeometryLimits& limits = instrument_.standard.geometry(id);
    const OpticalResponse& optics = model.optics();
    GeometryCertificate result{.id = id,
                               .theta_i_deg = limits.theta_i.nominal.degrees(),
                               .quantities = optics.quantities()};
    result.effects = deviation_effects(instrument_, limits, optics, model.equation());
    const VectorXd nominal = optics.with_standard_spectra(optics.nominal());
    const VectorXd as_built = optics(optics.as_built());
    const VectorXd read = model.at_estimates(as_built);
    const MatrixXd jacobian = model.jacobian();
    const MatrixXd secants = model.secants();
    const WorstCases worst = worst_cases(optics, limits);
    for (Index s = 0; s < read.size(); ++s) {
      const VectorXd error = jacobian.row(s) - secants.row(s);
      result.readings.push_back(
          {.nominal_gu = nominal[s],
           .gloss_gu = read[s],
           .before_adjustment_gu = before_adjustment(instrument_, id, as_built[s]),
           .propagated = propagate(set, jacobian.row(s).transpose(), certificate_.coverage),
           .sensitivity_error = {error.begin(), error.end()},
           .lowest = worst.lowest[std::size_t(s)],
           .highest = worst.highest[std::size_t(s)]});
    }
    model.fit(options_.seed);
    const VectorXd& error = model.surrogate_error();
    result.surrogate_error_gu.assign(error.begin(), error.end());
    result.direct_samples = model.direct();
    return result;
  }

  [[nodiscard]] MonteCarloOptions with_progress(MonteCarloOptions options) const {
    options.seed = options_.seed;
    options.coverage = certificate_.coverage;
    if (options_.advance) {
      const std::size_t total = options.trials.value_or(options.most_trials);
      options.advance = [this, total](std::size_t done) {
        options_.advance("trials", done, total);
      };
    }
    return options;
  }

  void run_monte_carlo(const InputSet& set) {
    const auto n_samples = Index(ladder_.size());
    const MonteCarloResult result = monte_carlo(
        set, models_.size() * ladder_.size(),
        [&](const ArrayXXd& x, ArrayXXd& y) {
          for (std::size_t g = 0; g < models_.size(); ++g) {
            models_[g]->evaluate(x, y.middleCols(Index(g) * n_samples, n_samples));
          }
        },
        with_progress({.trials = options_.trials}));
    certificate_.trials = result.trials;
    certificate_.is_stable = result.is_stable;
    for (std::size_t i = 0; i < result.outputs.size(); ++i) {
      record(i / ladder_.size(), i % ladder_.size(), result.outputs[i]);
    }
  }

  /// The same for readings that no polynomial is good enough for: fewer trials, one by one.
  void run_directly(const InputSet& set) {
    std::vector<Index> begin{0};  // of the outputs of each geometry
    for (const auto& model : models_) {
      begin.push_back(begin.back() + Index(model->direct().size()));
    }
    if (begin.back() == 0) {
      return;
    }
    const std::size_t trials =
        std::min(options_.trials.value_or(most_direct_trials), most_direct_trials);
    const MonteCarloResult result = monte_carlo(
        set, std::size_t(begin.back()),
        [&](const ArrayXXd& x, ArrayXXd& y) {
          for (std::size_t g = 0; g < models_.size(); ++g) {
            models_[g]->evaluate_directly(x, y.middleCols(begin[g], begin[g + 1] - begin[g]));
          }
        },
        with_progress({.trials = trials}));
    certificate_.direct_trials = result.trials;
    for (std::size_t g = 0; g < models_.size(); ++g) {
      const std::vector<std::size_t>& direct = models_[g]->direct();
      for (std::size_t i = 0; i < direct.size(); ++i) {
        record(g, direct[i], result.outputs[std::size_t(begin[g]) + i]);
      }
    }
  }

  void record(std::size_t geometry, std::size_t sample, const MonteCarloOutput& output) {
    CertifiedReading& reading = certificate_.geometries[geometry].readings[sample];
    reading.monte_carlo = output;
    reading.methods_agree = agree(reading);
  }

  static bool agree(const CertifiedReading& reading) {
    const double U = reading.propagated.expanded_uncertainty;
    const MonteCarloOutput& sampled = reading.monte_carlo;
    return std::abs(sampled.expanded_uncertainty() - U) <= agreement * U &&
           std::abs(sampled.mean - reading.gloss_gu) <= agreement * U;
  }

  const Instrument& instrument_;
  const std::vector<Sample>& ladder_;
  const CertifyOptions& options_;
  Certificate& certificate_;
  std::vector<std::unique_ptr<ReadingModel>> models_ = {};
};

}  // namespace

Certificate certify(const Instrument& built, const ClauseSet& clauses,
                    const std::vector<Sample>& ladder, const CertifyOptions& options) {
  const Instrument instrument = by_standard(built, clauses.standard.value());
  const std::vector<std::string> ids = geometries_of(instrument, options.geometries);
  Certificate certificate{.instrument = instrument,
                          .standard = instrument.standard,
                          .decision_rule = options.decision_rule,
                          .guard_band_factor = options.guard_band_factor,
                          .seed = options.seed};
  certificate.limits =
      judge_limits(instrument, clauses, ids,
                   {.rule = options.decision_rule, .guard_band_factor = options.guard_band_factor});
  certificate.verdict = verdict_of(certificate.limits);
  for (const Sample& sample : ladder) {
    certificate.samples.push_back(sample.id);
    certificate.sample_titles.push_back(sample.title);
  }
  Certification(instrument, ladder, options, certificate).run(ids);
  return certificate;
}

}  // namespace gonio

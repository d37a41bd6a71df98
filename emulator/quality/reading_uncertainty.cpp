#include "emulator/quality/reading_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/procedure/reading_model.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "emulator/procedure/uncertainty_inputs.hpp"
#include "emulator/uncertainty/propagation.hpp"

namespace gonio {

namespace {

/// Asked of the integrator, in GU: of an uncertainty two digits are enough.
constexpr double tolerance_gu = 1e-4;
constexpr double coverage_factor_of_decisions = 2.0;

/// The middle of the limits of a channel; nothing without limits.
std::optional<double> expected_gloss(const Batch& batch, std::uint32_t channel) {
  const Requirement* requirement = batch.requirement(channel);
  if (requirement == nullptr) {
    return std::nullopt;
  }
  const Interval& limits = requirement->limits;
  const double low = limits.low.value_or(limits.high.value_or(0.0));
  return 0.5 * (low + limits.high.value_or(low));
}

/// Of the samples that certificates show, the one that reads most like that.
Sample nearest_sample(const Instrument& instrument, const std::string& geometry, double gloss_gu) {
  std::vector<Sample> ladder = effect_ladder(WavelengthGrid::visible());
  const OpticalResponse optics(instrument, geometry, ladder, tolerance_gu);
  const Eigen::VectorXd read = optics(optics.as_built());
  Eigen::Index nearest = 0;
  (read.array() - gloss_gu).abs().minCoeff(&nearest);
  return std::move(ladder[std::size_t(nearest)]);
}

/// Of a reading, without the scatter of single readings and of the display.
double systematic_part(const Propagated& reading, const GeometryInputs& inputs) {
  double variance = reading.standard_uncertainty * reading.standard_uncertainty;
  for (const auto component :
       {UncertaintyComponent::resolution, UncertaintyComponent::repeatability}) {
    const double part = reading.budget[inputs.component_index[std::size_t(component)]].contribution;
    variance -= part * part;
  }
  return std::sqrt(std::max(0.0, variance));
}

ReadingUncertainty of_gloss(const Instrument& instrument, const std::string& geometry,
                            const Sample& sample) {
  const Behaviour& behaviour = instrument.behaviour;
  ReadingUncertainty result{.repeatability = std::hypot(behaviour.repeatability_gu,
                                                        behaviour.resolution_gu / std::sqrt(12.0))};
  if (!instrument.uncertainty) {
    return result;
  }
  const UncertaintyInputs inputs = uncertainty_inputs(instrument, {geometry});
  const std::vector<Sample> samples{sample};
  const ReadingModel model(instrument, inputs.set, inputs.geometries.front(), samples,
                           tolerance_gu);
  const Propagated reading = propagate(inputs.set, model.jacobian().row(0).transpose());
  result.systematic = systematic_part(reading, inputs.geometries.front());
  result.expanded = coverage_factor_of_decisions * reading.standard_uncertainty;
  return result;
}

/// From those of both geometries; nothing if one of them has none.
ReadingUncertainty of_haze(const Batch& batch, const std::string& id,
                           const ReadingUncertainty* of_instrument) {
  double squares = 0.0;
  bool all_stated = true;
  for (const HazeRule& rule : batch.standard.haze) {
    for (std::size_t c = 0; rule.id == id && c < batch.channels.size(); ++c) {
      const BatchChannel& channel = batch.channels[c];
      if (channel.kind == BatchChannel::Kind::gloss &&
          (channel.geometry == rule.from || channel.geometry == rule.minus)) {
        all_stated = all_stated && of_instrument[c].expanded;
        squares += std::pow(of_instrument[c].expanded.value_or(0.0), 2);
      }
    }
  }
  return {.expanded = all_stated ? std::optional(std::sqrt(squares)) : std::nullopt};
}

void expect_stated(const Batch& batch, const ReadingUncertainties& uncertainties) {
  if (batch.decision.rule == DecisionRule::simple) {
    return;
  }
  for (const Requirement& requirement : batch.requirements) {
    for (std::size_t i = 0; i < batch.instruments.size(); ++i) {
      if (!uncertainties[i * batch.channels.size() + requirement.channel].expanded) {
        SourceMark mark = batch.decision.mark;
        mark.key = "decision.expanded_uncertainty";
        throw InputError(mark,
                         fmt::format("an uncertainty, since {} states none, or `rule: simple`",
                                     batch.instruments[i].id),
                         "nothing");
      }
    }
  }
}

}  // namespace

ReadingUncertainties reading_uncertainties(const Batch& batch,
                                           const std::optional<Sample>& sample) {
  const std::size_t n = batch.channels.size();
  ReadingUncertainties result(batch.instruments.size() * n);
  parallel_for(result.size(), [&](std::size_t place) {
    const Instrument& instrument = batch.instruments[place / n];
    const BatchChannel& channel = batch.channels[place % n];
    if (channel.kind != BatchChannel::Kind::gloss) {
      return;
    }
    const auto expected = expected_gloss(batch, std::uint32_t(place % n));
    if (sample || (expected && instrument.uncertainty)) {
      result[place] =
          of_gloss(instrument, channel.geometry,
                   sample ? *sample : nearest_sample(instrument, channel.geometry, *expected));
    }
    if (batch.decision.expanded_uncertainty_gu) {
      result[place].expanded = batch.decision.expanded_uncertainty_gu;
    }
  });
  for (std::size_t place = 0; place < result.size(); ++place) {
    const BatchChannel& channel = batch.channels[place % n];
    if (channel.kind == BatchChannel::Kind::haze) {
      result[place] = of_haze(batch, channel.id, &result[place - place % n]);
    } else if (channel.kind == BatchChannel::Kind::colour_difference) {
      result[place].expanded = 0.0;
    }
  }
  expect_stated(batch, result);
  return result;
}

}  // namespace gonio

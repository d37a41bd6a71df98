#include "emulator/quality/panel_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "emulator/procedure/evaluation.hpp"

namespace gonio {

namespace {

using enum ConformanceVerdict;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Gloss by geometry, of what is finite.
std::map<std::string, double> gloss_by_geometry(const Batch& batch,
                                                const std::vector<double>& mean) {
  std::map<std::string, double> gloss;
  for (std::size_t c = 0; c < batch.channels.size(); ++c) {
    if (batch.channels[c].kind == BatchChannel::Kind::gloss && std::isfinite(mean[c])) {
      gloss.emplace(batch.channels[c].geometry, mean[c]);
    }
  }
  return gloss;
}

std::vector<double> means_of(const Batch& batch, const PanelRecord& panel) {
  std::vector<double> mean(batch.channels.size(), none);
  for (const ChannelResult& result : panel.channels) {
    mean[result.channel] = result.mean;
  }
  return mean;
}

std::vector<double> values_of(const PanelRecord& panel, std::uint32_t channel) {
  std::vector<double> values;
  for (const ReadingRecord& reading : panel.readings) {
    if (reading.channel == channel) {
      values.push_back(reading.value);
    }
  }
  if (values.empty()) {
    throw std::invalid_argument(
        fmt::format("panel {}: no reading of channel {}", panel.number, channel));
  }
  return values;
}

/// A pass that rests on too few readings is none.
ConformanceVerdict with_uniformity(ConformanceVerdict verdict, PanelVerdict uniformity) {
  if (uniformity == PanelVerdict::rejected) {
    return fail;
  }
  return uniformity == PanelVerdict::more_readings && verdict == pass ? inconclusive : verdict;
}

}  // namespace

std::optional<std::string> selected_geometry(const Batch& batch, const std::vector<double>& mean) {
  if (!batch.selected_only) {
    return std::nullopt;
  }
  return batch.standard.select_geometry(gloss_by_geometry(batch, mean));
}

double haze_of(const Batch& batch, std::uint32_t channel, const std::vector<double>& mean) {
  for (const HazeRule& rule : batch.standard.haze) {
    if (rule.id == batch.channels[channel].id) {
      return haze(rule, gloss_by_geometry(batch, mean)).value.value_or(none);
    }
  }
  return none;
}

bool counts(const Batch& batch, const Requirement& requirement,
            const std::optional<std::string>& selected) {
  const BatchChannel& channel = batch.channels[requirement.channel];
  return !selected || channel.kind != BatchChannel::Kind::gloss || channel.geometry == *selected;
}

PanelJudge::PanelJudge(const Batch& batch, const ReadingUncertainties& uncertainties)
    : batch_(batch), uncertainties_(uncertainties) {
  if (batch.standard.readings) {
    of_gloss_ = *batch.standard.readings;
  }
}

double PanelJudge::expanded_uncertainty(std::uint32_t channel) const {
  double largest = 0.0;
  for (std::size_t i = channel; i < uncertainties_.size(); i += batch_.channels.size()) {
    largest = std::max(largest, uncertainties_[i].expanded.value_or(0.0));
  }
  return largest;
}

double PanelJudge::expanded_uncertainty(const PanelRecord& panel, std::uint32_t channel) const {
  double largest = 0.0;
  for (const ReadingRecord& reading : panel.readings) {
    const std::size_t place = reading.instrument * batch_.channels.size() + channel;
    largest = std::max(largest, uncertainties_.at(place).expanded.value_or(0.0));
  }
  return largest;
}

void PanelJudge::decide_limits(PanelRecord& panel) const {
  const auto selected = selected_geometry(batch_, means_of(batch_, panel));
  for (const Requirement& requirement : batch_.requirements) {
    const auto result =
        std::find_if(panel.channels.begin(), panel.channels.end(),
                     [&](const ChannelResult& one) { return one.channel == requirement.channel; });
    if (result == panel.channels.end() || !counts(batch_, requirement, selected)) {
      continue;
    }
    const double U =
        batch_.decision.guard_band_factor * expanded_uncertainty(panel, requirement.channel);
    result->verdict = with_uniformity(
        decide(result->mean, U, requirement.limits, batch_.decision.rule), result->uniformity);
    panel.verdict = worse(panel.verdict, result->verdict);
  }
}

std::size_t PanelJudge::judge(PanelRecord& panel) const {
  std::size_t further = 0;
  panel.channels.clear();
  panel.verdict = not_applicable;
  for (std::uint32_t c = 0; c < batch_.channels.size(); ++c) {
    const BatchChannel::Kind kind = batch_.channels[c].kind;
    if (kind == BatchChannel::Kind::haze) {
      if (const double value = haze_of(batch_, c, means_of(batch_, panel)); std::isfinite(value)) {
        panel.channels.push_back({.channel = c, .mean = value});
      }
      continue;
    }
    const PanelResult result = judge_panel(
        values_of(panel, c), kind == BatchChannel::Kind::gloss ? of_gloss_ : of_colour_);
    panel.channels.push_back({.channel = c,
                              .n = std::uint32_t(result.n),
                              .mean = result.mean_gu,
                              .range = result.range_gu,
                              .standard_deviation = result.standard_deviation_gu,
                              .uniformity = result.verdict});
    further = std::max(further, result.further);
  }
  decide_limits(panel);
  return further;
}

LotJudge::LotJudge(const Batch& batch, const PanelJudge& judge)
    : batch_(batch), judge_(judge), means_(batch.channels.size()) {}

void LotJudge::add(const PanelRecord& panel) {
  lot_.number = panel.lot;
  ++lot_.panels;
  lot_.nonconforming += panel.verdict == fail ? 1 : 0;
  lot_.inconclusive += panel.verdict == inconclusive ? 1 : 0;
  const bool is_rejected = std::any_of(
      panel.channels.begin(), panel.channels.end(),
      [](const ChannelResult& result) { return result.uniformity == PanelVerdict::rejected; });
  lot_.not_uniform += is_rejected ? 1 : 0;
  for (const ChannelResult& result : panel.channels) {
    means_[result.channel].add(result.mean);
  }
}

ConformanceVerdict LotJudge::by_attributes() const {
  const std::uint64_t c = batch_.plan.accept.nonconforming;
  if (lot_.nonconforming > c) {
    return fail;
  }
  return lot_.nonconforming + lot_.inconclusive <= c ? pass : inconclusive;
}

/// By the mean, or by variables: then the limits are k standard deviations nearer.
ConformanceVerdict LotJudge::by_means() const {
  const double k =
      batch_.plan.accept.kind == AcceptanceRule::Kind::variables ? batch_.plan.accept.k : 0.0;
  const auto selected = selected_geometry(batch_, lot_.mean);
  ConformanceVerdict verdict = not_applicable;
  for (const Requirement& requirement : batch_.requirements) {
    const ChannelStatistics& of_panels = means_[requirement.channel].result();
    if (of_panels.n == 0 || !counts(batch_, requirement, selected)) {
      continue;
    }
    const double nearer = k * of_panels.standard_deviation;
    Interval limits = requirement.limits;
    if (limits.low) {
      *limits.low += nearer;
    }
    if (limits.high) {
      *limits.high -= nearer;
    }
    const double U =
        batch_.decision.guard_band_factor * judge_.expanded_uncertainty(requirement.channel);
    verdict = worse(verdict, decide(of_panels.mean, U, limits, batch_.decision.rule));
  }
  return verdict;
}

LotSummary LotJudge::result() {
  lot_.mean.clear();
  for (const RunningStatistics& of_panels : means_) {
    lot_.mean.push_back(of_panels.result().n == 0 ? none : of_panels.result().mean);
  }
  lot_.verdict =
      batch_.plan.accept.kind == AcceptanceRule::Kind::attributes ? by_attributes() : by_means();
  LotSummary result = lot_;
  lot_ = {};
  means_.assign(batch_.channels.size(), {});
  return result;
}

std::string acceptance_words(const Batch& batch) {
  const AcceptanceRule& accept = batch.plan.accept;
  switch (accept.kind) {
    case AcceptanceRule::Kind::attributes:
      return accept.nonconforming == 0
                 ? "a lot is accepted if all of its panels conform"
                 : fmt::format("a lot is accepted if at most {} of its panels {} not conform",
                               accept.nonconforming, accept.nonconforming == 1 ? "does" : "do");
    case AcceptanceRule::Kind::mean:
      return "a lot is accepted if the mean of its panels keeps within the limits";
    case AcceptanceRule::Kind::variables:
      break;
  }
  return fmt::format(
      "a lot is accepted if its mean keeps {:g} standard deviations of its panels away from the "
      "limits",
      accept.k);
}

std::string decision_words(const Batch& batch) {
  if (batch.decision.rule == DecisionRule::simple) {
    return decision_rule_words(DecisionRule::simple);
  }
  const double factor = batch.decision.guard_band_factor;
  const std::string band = factor == 1.0 ? "U" : fmt::format("{:g} U", factor);
  return fmt::format(
      "guarded: pass if the value is within the limit by at least {0} (U for k = 2), fail if it is "
      "beyond it by more than {0}, else inconclusive",
      band);
}

}  // namespace gonio

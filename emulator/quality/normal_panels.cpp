#include "emulator/quality/normal_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "emulator/procedure/evaluation.hpp"
#include "emulator/statistics/sampling_plan.hpp"
#include "emulator/uncertainty/random.hpp"

namespace gonio {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Streams of draws: those of a lot and of the panel of the same number have nothing in common.
enum Stream : std::uint64_t { of_lots = 1, of_panels = 2, of_errors = 3 };

const HazeRule* haze_rule(const Batch& batch, std::size_t channel) {
  const auto& rules = batch.standard.haze;
  const auto rule = std::find_if(rules.begin(), rules.end(), [&](const HazeRule& one) {
    return one.id == batch.channels[channel].id;
  });
  return rule == rules.end() ? nullptr : &*rule;
}

/// Place of the gloss of a geometry among the channels, or their number.
std::size_t gloss_channel(const Batch& batch, const std::string& geometry) {
  const auto& channels = batch.channels;
  return std::size_t(std::find_if(channels.begin(), channels.end(),
                                  [&](const BatchChannel& channel) {
                                    return channel.kind == BatchChannel::Kind::gloss &&
                                           channel.geometry == geometry;
                                  }) -
                     channels.begin());
}

}  // namespace

NormalPanels::NormalPanels(const Batch& batch, const ReadingUncertainties& uncertainties,
                           NormalProduct product)
    : batch_(batch),
      uncertainties_(uncertainties),
      judge_(batch, uncertainties),
      product_(std::move(product)) {
  if (product_.channels.size() != batch.channels.size()) {
    throw std::invalid_argument(fmt::format("NormalPanels: expected {} channels, found {}",
                                            batch.channels.size(), product_.channels.size()));
  }
  for (std::uint32_t c = 0; c < batch.channels.size(); ++c) {
    if (batch.channels[c].kind != BatchChannel::Kind::haze) {
      read_channels_.push_back(c);
    }
  }
}

std::vector<double> NormalPanels::lot_means(std::uint64_t lot) const {
  std::vector<double> mean(batch_.channels.size());
  Draws(batch_.seed, lot, of_lots).normal(mean);
  for (std::size_t c = 0; c < mean.size(); ++c) {
    mean[c] = product_.channels[c].mean + product_.channels[c].sd_lots * mean[c];
  }
  return mean;
}

std::vector<double> NormalPanels::errors(std::uint64_t lot, std::size_t instrument) const {
  const std::size_t n = batch_.channels.size();
  std::vector<double> draws((instrument + 1) * n);
  Draws(batch_.seed, lot, of_errors).normal(draws);
  std::vector<double> errors(n);
  for (std::size_t c = 0; c < n; ++c) {
    errors[c] = uncertainties_.at(instrument * n + c).systematic * draws[instrument * n + c];
  }
  return errors;
}

/// Haze of values by channel: nothing where the standard does not define it.
void NormalPanels::add_haze(std::vector<double>& truth) const {
  std::map<std::string, double> gloss;
  for (const std::uint32_t c : read_channels_) {
    if (batch_.channels[c].kind == BatchChannel::Kind::gloss) {
      gloss.emplace(batch_.channels[c].geometry, truth[c]);
    }
  }
  for (std::size_t c = 0; c < truth.size(); ++c) {
    if (batch_.channels[c].kind == BatchChannel::Kind::haze) {
      const HazeRule* rule = haze_rule(batch_, c);
      truth[c] = rule == nullptr ? none : haze(*rule, gloss).value.value_or(none);
    }
  }
}

/// Positions from `first` to before `end`.
/// @param shown  by channel, without noise.
void NormalPanels::read(PanelRecord& panel, std::span<const double> shown, std::size_t first,
                        std::size_t end) const {
  const std::size_t repetitions = batch_.plan.repetitions;
  const std::size_t of_position = repetitions * read_channels_.size();
  // Draw by draw the same, wherever readings begin and end.
  const std::size_t before = batch_.channels.size();
  std::vector<double> noise(before + end * of_position);
  Draws(batch_.seed, panel.number, of_panels).normal(noise);
  const std::size_t appraiser = (panel.number - 1) % batch_.appraisers();
  for (std::size_t place = first * of_position; place < end * of_position; ++place) {
    const std::uint32_t c = read_channels_[place % read_channels_.size()];
    panel.readings.push_back(
        {.channel = c,
         .position = std::uint32_t(place / of_position + 1),
         .repetition = std::uint32_t(place / read_channels_.size() % repetitions + 1),
         .instrument = std::uint32_t(appraiser / batch_.operators.size()),
         .operator_ = std::uint32_t(appraiser % batch_.operators.size()),
         .value = shown[c] + product_.channels[c].sd_readings * noise[before + place]});
  }
}

PanelRecord NormalPanels::inspect(std::uint64_t number) const {
  PanelRecord panel{.number = number, .lot = (number - 1) / batch_.plan.panels + 1};
  const std::size_t appraiser = (number - 1) % batch_.appraisers();
  std::vector<double> truth = lot_means(panel.lot);
  std::vector<double> deviations(truth.size());
  Draws(batch_.seed, number, of_panels).normal(deviations);
  std::vector<double> shown = errors(panel.lot, appraiser / batch_.operators.size());
  for (std::size_t c = 0; c < truth.size(); ++c) {
    truth[c] += product_.channels[c].sd_panels * deviations[c];
    shown[c] += truth[c];
  }
  add_haze(truth);
  const std::size_t positions = batch_.plan.positions.size();
  const std::size_t further = batch_.plan.further_positions.size();
  read(panel, shown, 0, positions);
  if (judge_.judge(panel) > 0 && further > 0) {
    read(panel, shown, positions, positions + further);
    judge_.judge(panel);
  }
  for (ChannelResult& result : panel.channels) {
    if (std::isfinite(truth[result.channel])) {
      result.truth = truth[result.channel];
    }
  }
  return panel;
}

LotTruth NormalPanels::truth(std::uint64_t lot) const {
  const std::size_t n = batch_.channels.size();
  LotTruth truth{.mean = lot_means(lot), .sd = std::vector<double>(n), .beyond = {}};
  add_haze(truth.mean);
  for (std::size_t c = 0; c < n; ++c) {
    truth.sd[c] = product_.channels[c].sd_panels;
    if (const HazeRule* rule = haze_rule(batch_, c);
        rule != nullptr && std::isfinite(truth.mean[c])) {
      truth.sd[c] = std::hypot(product_.channels[gloss_channel(batch_, rule->from)].sd_panels,
                               product_.channels[gloss_channel(batch_, rule->minus)].sd_panels);
    }
    const Requirement* requirement = batch_.requirement(std::uint32_t(c));
    truth.beyond.push_back(requirement == nullptr || !std::isfinite(truth.mean[c])
                               ? 0.0
                               : beyond_limits(truth.mean[c], truth.sd[c], requirement->limits));
  }
  return truth;
}

std::optional<NormalComponents> NormalPanels::normal_components(std::uint32_t channel) const {
  if (batch_.channels.at(channel).kind == BatchChannel::Kind::haze) {
    return std::nullopt;
  }
  return product_.channels[channel];
}

NormalProduct normal_product(const QaResult& result) {
  NormalProduct product;
  for (const ChannelSummary& channel : result.channels) {
    product.channels.push_back({.mean = channel.mean,
                                .sd_lots = channel.spread.sd_lots,
                                .sd_panels = channel.spread.sd_panels,
                                .sd_readings = channel.spread.sd_readings});
  }
  return product;
}

}  // namespace gonio

#include "emulator/quality/batch_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {

namespace {

using enum ConformanceVerdict;

constexpr std::size_t most_lots = 100;  // that QaResult lists
/// 0.95 of 20 lots is 19 of them, whatever the last bit.
constexpr double last_bits_of_lots = 1e-9;

/// Where a position is, and what its spot covers by the first instrument. Of a batch that states no
/// product the panel is not known, nor where on it is what.
void fill_place(const Batch& batch, const BatchChannel& channel, PositionSummary& position) {
  const std::vector<PanelPlace>& first = batch.plan.positions;
  const std::vector<PanelPlace>& further = batch.plan.further_positions;
  const std::size_t place = position.position - 1;
  if (!batch.product || position.position == 0 || place >= first.size() + further.size()) {
    return;
  }
  const PanelPlace& at = place < first.size() ? first[place] : further[place - first.size()];
  position.x_mm = at.x_mm;
  position.y_mm = at.y_mm;
  const Instrument& instrument = batch.instruments.front();
  if (instrument.has(channel.geometry)) {
    const Spot spot = instrument.spot(channel.geometry, at.x_mm, at.y_mm);
    position.half_length_mm = spot.half_length_mm;
    position.half_width_mm = spot.half_width_mm;
  }
}

std::size_t least_capable(const std::vector<ChannelSummary>& channels) {
  std::size_t least = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto& of_channel = channels[c].capability;
    if (of_channel && of_channel->cpk && of_channel->cpk->value < lowest) {
      lowest = of_channel->cpk->value;
      least = c;
    }
  }
  return least;
}

}  // namespace

ConformanceVerdict batch_verdict(std::uint64_t accepted, std::uint64_t refused,
                                 std::uint64_t inconclusive_lots, double share) {
  const std::uint64_t lots = accepted + refused + inconclusive_lots;
  if (lots == 0) {
    return not_applicable;
  }
  const double needed = share * double(lots) - last_bits_of_lots;
  if (double(accepted) >= needed) {
    return pass;
  }
  return double(lots - refused) < needed ? fail : inconclusive;
}

BatchSummary::BatchSummary(const Batch& batch, const PanelJudge& judge)
    : batch_(batch),
      judge_(judge),
      open_lot_(batch, judge),
      channels_(batch.channels.size(), ChannelTally(batch.control_baseline)),
      gauge_(batch) {}

void BatchSummary::close_lot(LotJudge& open, QaResult& counted) const {
  LotSummary lot = open.result();
  counted.lots_accepted += lot.verdict == pass ? 1 : 0;
  counted.lots_refused += lot.verdict == fail ? 1 : 0;
  counted.lots_inconclusive += lot.verdict == inconclusive ? 1 : 0;
  if (counted.lots.size() < most_lots) {
    counted.lots.push_back(std::move(lot));
  }
}

void BatchSummary::add(const PanelRecord& panel) {
  if (panel.study == PanelRecord::Study::gauge) {
    gauge_.add(panel);
    return;
  }
  if (counted_.panels > 0 && panel.lot != open_number_) {
    close_lot(open_lot_, counted_);
  }
  open_number_ = panel.lot;
  open_lot_.add(panel);
  ++counted_.panels;
  counted_.readings += panel.readings.size();
  counted_.panels_passed += panel.verdict == pass ? 1 : 0;
  counted_.panels_failed += panel.verdict == fail ? 1 : 0;
  counted_.panels_inconclusive += panel.verdict == inconclusive ? 1 : 0;
  for (const ChannelResult& result : panel.channels) {
    channels_[result.channel].add(panel.lot, result);
  }
  for (const ReadingRecord& reading : panel.readings) {
    channels_[reading.channel].add(reading);
  }
}

ChannelSummary BatchSummary::channel_summary(std::uint32_t channel) const {
  const Requirement* requirement = batch_.requirement(channel);
  ChannelSummary summary =
      channels_[channel].result(requirement == nullptr ? Interval{} : requirement->limits);
  summary.channel = batch_.channels[channel];
  if (requirement != nullptr) {
    summary.target = requirement->target;
  }
  summary.expanded_uncertainty = judge_.expanded_uncertainty(channel);
  for (PositionSummary& position : summary.positions) {
    fill_place(batch_, summary.channel, position);
  }
  return summary;
}

QaResult BatchSummary::result() const {
  QaResult result = counted_;
  if (result.panels > 0) {
    LotJudge last = open_lot_;
    close_lot(last, result);
  }
  result.verdict = batch_verdict(result.lots_accepted, result.lots_refused,
                                 result.lots_inconclusive, batch_.plan.accepted_lots);
  result.decision = decision_words(batch_);
  result.acceptance = acceptance_words(batch_);
  for (std::uint32_t c = 0; c < channels_.size(); ++c) {
    result.channels.push_back(channel_summary(c));
  }
  result.main_channel = least_capable(result.channels);
  if (batch_.product) {
    result.panel_length_mm = batch_.product->panel_length_mm;
    result.panel_width_mm = batch_.product->panel_width_mm;
  }
  result.gauge = gauge_.result();
  return result;
}

}  // namespace gonio

#include "emulator/quality/qa_result.hpp"

namespace gonio {

namespace {

std::optional<double> value_of(const std::optional<Estimate>& estimate) {
  return estimate ? std::optional(estimate->value) : std::nullopt;
}

ChannelTrend trend_of(std::uint32_t number, const ChannelSummary& channel) {
  ChannelTrend trend{.channel = number,
                     .panels = channel.panels,
                     .readings = channel.readings,
                     .mean = channel.mean,
                     .standard_deviation = channel.standard_deviation,
                     .low = channel.limits.low,
                     .high = channel.limits.high};
  if (channel.capability) {
    trend.cpk = value_of(channel.capability->cpk);
    trend.ppk = value_of(channel.capability->ppk);
  }
  return trend;
}

}  // namespace

RunOutcome QaResult::outcome(const std::string& finished) const {
  RunOutcome result{
      .verdict = verdict, .finished = finished, .panels = panels, .readings = readings};
  if (risks) {
    result.producer_risk = risks->lot.producer.value;
    result.consumer_risk = risks->lot.consumer.value;
  }
  for (std::uint32_t c = 0; c < channels.size(); ++c) {
    result.channels.push_back(trend_of(c, channels[c]));
  }
  return result;
}

}  // namespace gonio

#include "emulator/quality/channel_tally.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

/// Numbers of further positions are not kept: no panel is read at so many places but one whose
/// file says so by mistake.
constexpr std::size_t most_positions = 2000;
constexpr std::uint64_t least_baseline = 2;

}  // namespace

void MovingSpread::add(double value) {
  if (values_ > 0) {
    ranges_.add(std::abs(value - last_));
  }
  last_ = value;
  ++values_;
}

// With sigma = 1 the difference of two values has the variance 2, and those of neighbouring pairs
// are correlated by -1/2. So a range has the mean d2 and the variance 2 - d2^2, and neighbours have
// the covariance (4 / pi) (sqrt(1 - 1/4) + 1/2 asin(1/2)) - d2^2.
EstimatedSpread MovingSpread::result() const {
  if (values_ < 2) {
    return {};
  }
  constexpr double pi = std::numbers::pi;
  const double d2 = 2.0 / std::sqrt(pi);
  const double variance = 2.0 - d2 * d2;
  const double covariance = 4.0 / pi * (std::sqrt(0.75) + pi / 12.0) - d2 * d2;
  const double n = double(values_ - 1);
  const double of_mean = (n * variance + 2.0 * (n - 1.0) * covariance) / (n * n);
  return {.value = ranges_.result().mean / d2, .degrees_of_freedom = d2 * d2 / (2.0 * of_mean)};
}

ChannelTally::ChannelTally(std::uint64_t baseline) : charts_(std::max(baseline, least_baseline)) {}

void ChannelTally::add(std::uint64_t lot, const ChannelResult& panel) {
  means_.add(panel.mean);
  ranges_.add(panel.range);
  neighbours_.add(panel.mean);
  // Haze has no readings: there the panel is its own only one.
  const std::size_t n = std::max(panel.n, 1U);
  nested_.add(lot, n, panel.mean, panel.standard_deviation);
  charts_.add(n, panel.mean, panel.range);
  histogram_.add(panel.mean);
  ++counted_.panels;
  counted_.readings += panel.n;
  ++counted_.uniformity[std::size_t(panel.uniformity)];
  counted_.passed += panel.verdict == ConformanceVerdict::pass ? 1 : 0;
  counted_.failed += panel.verdict == ConformanceVerdict::fail ? 1 : 0;
  counted_.inconclusive += panel.verdict == ConformanceVerdict::inconclusive ? 1 : 0;
}

void ChannelTally::add(const ReadingRecord& reading) {
  auto place = positions_.find(reading.position);
  if (place == positions_.end()) {
    if (positions_.size() == most_positions) {
      return;
    }
    place = positions_.emplace(reading.position, RunningStatistics()).first;
  }
  place->second.add(reading.value);
}

std::optional<Capability> ChannelTally::capability_within(const Interval& limits) const {
  const ChannelStatistics& panels = means_.result();
  if (panels.n < 2 || (!limits.low && !limits.high)) {
    return std::nullopt;
  }
  return capability(
      panels.mean, std::size_t(panels.n), neighbours_.result(),
      {.value = panels.standard_deviation, .degrees_of_freedom = double(panels.n - 1)}, limits);
}

ChannelSummary ChannelTally::result(const Interval& limits) const {
  const ChannelStatistics& panels = means_.result();
  ChannelSummary summary = counted_;
  summary.limits = limits;
  summary.mean = panels.mean;
  summary.standard_deviation = panels.standard_deviation;
  summary.lowest = panels.minimum;
  summary.highest = panels.maximum;
  summary.mean_range = ranges_.result().mean;
  summary.spread = nested_.result();
  summary.capability = capability_within(limits);
  summary.charts = charts_.result();
  summary.histogram = histogram_.bins();
  for (const auto& [number, of_place] : positions_) {
    const ChannelStatistics& readings = of_place.result();
    summary.positions.push_back({.position = number,
                                 .readings = std::uint64_t(readings.n),
                                 .mean = readings.mean,
                                 .standard_deviation = readings.standard_deviation});
  }
  return summary;
}

}  // namespace gonio

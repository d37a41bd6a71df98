// What a device makes of its readings by itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

namespace {

constexpr int usual_readings = 5;

/// Largest deviation of the device's own statistics from those of its readings.
double statistics_deviation(const ChannelStatistics& theirs, const ChannelStatistics& ours) {
  return std::max({std::abs(theirs.mean - ours.mean), std::abs(theirs.range() - ours.range()),
                   std::abs(theirs.standard_deviation - ours.standard_deviation),
                   std::abs(double(theirs.n - ours.n))});
}

/// One sample, or several of different gloss, whose readings differ as those of one spot do not.
std::vector<std::string> read_samples(YamlMap& when, MeasurandContext& context) {
  std::vector<std::string> samples;
  if (const auto list = when.optional("samples")) {
    for (const YamlNode& node : list->list()) {
      samples.push_back(node.id());
    }
  } else {
    samples.push_back(when.required("sample").id());
  }
  context.samples.insert(samples.begin(), samples.end());
  return samples;
}

/// Readings of several samples, one after the other, by channel.
std::vector<ChannelReadings> read_one_after_the_other(Bench& bench,
                                                      const std::vector<std::string>& samples,
                                                      int readings) {
  std::vector<ChannelReadings> all = bench.read(PortCover::sample, samples.front(), readings);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto more = bench.read(PortCover::sample, samples[i], readings);
    for (std::size_t j = 0; j < all.size(); ++j) {
      all[j].gloss_gu.insert(all[j].gloss_gu.end(), more[j].gloss_gu.begin(),
                             more[j].gloss_gu.end());
      all[j].is_over_range = all[j].is_over_range || more[j].is_over_range;
    }
  }
  return all;
}

Measurement read_statistics(YamlMap& when, MeasurandContext& context) {
  const std::vector<std::string> samples = read_samples(when, context);
  const auto stated = when.optional("readings");
  const int readings = stated ? stated->integer(1, 999) : usual_readings;
  return [=](const MeasurementContext& c) {
    c.bench.prepare();
    (void)c.bench.read(PortCover::tile, {}, 1);  // to be forgotten
    c.bench.must(DeviceCommand::clear_statistics);
    std::vector<Finding> findings;
    const auto all = read_one_after_the_other(c.bench, samples, readings);
    const PortStatus status = c.bench.port().status();
    for (const ChannelReadings& one : all) {
      const bool is_meant = !c.clause.geometry || *c.clause.geometry == one.geometry;
      if (!is_meant || one.is_over_range) {
        continue;
      }
      const ChannelStatistics& theirs = status.statistics.at(*c.bench.channel(one.geometry));
      findings.push_back({.geometry = one.geometry,
                          .subject = fmt::format("{}", fmt::join(samples, ", ")),
                          .unit = "GU",
                          .value = statistics_deviation(theirs, one.statistics()),
                          .note = fmt::format("of {} readings", one.gloss_gu.size())});
    }
    return findings;
  };
}

}  // namespace

std::map<std::string, MeasurandReader> statistics_measurands() {
  return {{"statistics", read_statistics}};
}

}  // namespace gonio::conformance

#include "emulator/quality/measured_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace gonio {

namespace {

auto without_position(const ReadingRecord& reading) {
  return std::make_tuple(reading.channel, reading.instrument, reading.operator_,
                         reading.repetition);
}

auto with_position(const ReadingRecord& reading) {
  return std::tuple_cat(without_position(reading), std::make_tuple(reading.position));
}

/// Places of readings in the order of a key; those with the same key as they came.
template <class Key>
std::vector<std::size_t> in_order(const std::vector<ReadingRecord>& readings, Key key) {
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return key(readings[a]) < key(readings[b]);
  });
  return order;
}

std::string name_of(const PanelRecord& panel) {
  return panel.label.empty() ? "each panel" : fmt::format("panel {}", panel.label);
}

}  // namespace

void MeasuredPanel::number_positions() {
  std::vector<ReadingRecord>& readings = record.readings;
  const auto order = in_order(readings, without_position);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const ReadingRecord& before = readings[order[i - 1]];
    ReadingRecord& reading = readings[order[i]];
    if (without_position(before) == without_position(reading)) {
      reading.position = before.position + 1;
    }
  }
}

void MeasuredPanel::expect_no_doubles(const Batch& batch, const std::string& file) const {
  const std::vector<ReadingRecord>& readings = record.readings;
  const auto order = in_order(readings, with_position);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const ReadingRecord& reading = readings[order[i]];
    if (with_position(reading) == with_position(readings[order[i - 1]])) {
      const Place& place = places[order[i]];
      throw InputError(
          {.file = file, .line = place.line, .column = place.column},
          "each reading once (a column for the repetition tells them apart)",
          fmt::format("{}, channel {}, position {}, repetition {} a second time, after line {}",
                      name_of(record), batch.channels[reading.channel].id, reading.position,
                      reading.repetition, places[order[i - 1]].line));
    }
  }
}

void MeasuredPanel::expect_all_channels(const Batch& batch, const std::string& file) const {
  for (std::uint32_t c = 0; c < batch.channels.size(); ++c) {
    const bool has_readings = batch.channels[c].kind != BatchChannel::Kind::haze;
    if (has_readings &&
        std::ranges::find(record.readings, c, &ReadingRecord::channel) == record.readings.end()) {
      throw InputError(
          {.file = file, .line = places.front().line, .column = 1},
          fmt::format("readings of {} in the channel {}", name_of(record), batch.channels[c].id),
          "none");
    }
  }
}

}  // namespace gonio

#include "emulator/quality/gauge_tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gonio {

void GaugeTally::add(const PanelRecord& panel) {
  for (const ReadingRecord& reading : panel.readings) {
    const std::size_t appraiser = reading.instrument * batch_.operators.size() + reading.operator_;
    channels_[reading.channel][{.panel = panel.number, .appraiser = appraiser}].push_back(
        reading.value);
  }
}

std::string GaugeTally::appraiser_name(std::size_t appraiser) const {
  const std::size_t operators = batch_.operators.size();
  return fmt::format("{}, {}", batch_.instruments.at(appraiser / operators).id,
                     batch_.operators.at(appraiser % operators).id);
}

std::optional<ChannelGauge> GaugeTally::study(std::uint32_t channel, const Cells& cells) const {
  std::set<std::size_t> appraisers;
  std::map<std::uint64_t, std::size_t> read_by;  // how many, by panel
  for (const auto& [cell, values] : cells) {
    appraisers.insert(cell.appraiser);
    ++read_by[cell.panel];
  }
  std::erase_if(read_by, [&](const auto& panel) { return panel.second < appraisers.size(); });
  GaugeReadings readings{.parts = read_by.size(), .appraisers = appraisers.size()};
  bool first = true;
  for (const auto& [cell, values] : cells) {
    if (read_by.contains(cell.panel)) {
      readings.repetitions = first ? values.size() : std::min(readings.repetitions, values.size());
      first = false;
    }
  }
  if (readings.parts < 2 || readings.repetitions < 2) {
    return std::nullopt;
  }
  for (const auto& [cell, values] : cells) {
    if (read_by.contains(cell.panel)) {
      const auto end = values.begin() + std::ptrdiff_t(readings.repetitions);
      readings.values.insert(readings.values.end(), values.begin(), end);
    }
  }
  std::optional<double> tolerance;
  const Requirement* requirement = batch_.requirement(channel);
  if (requirement != nullptr && requirement->limits.low && requirement->limits.high) {
    tolerance = *requirement->limits.high - *requirement->limits.low;
  }
  ChannelGauge result{.channel = channel,
                      .panels = readings.parts,
                      .repetitions = std::uint32_t(readings.repetitions),
                      .study = gauge_study(readings, tolerance)};
  for (const std::size_t appraiser : appraisers) {
    result.appraisers.push_back(appraiser_name(appraiser));
  }
  return result;
}

std::vector<ChannelGauge> GaugeTally::result() const {
  std::vector<ChannelGauge> result;
  for (const auto& [channel, cells] : channels_) {
    if (auto of_channel = study(channel, cells)) {
      result.push_back(std::move(*of_channel));
    }
  }
  return result;
}

}  // namespace gonio

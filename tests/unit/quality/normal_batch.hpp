#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/reading_uncertainty.hpp"
#include "emulator/quality/records.hpp"

// Batches that need no files but those of the standard.

namespace gonio::test {

inline const Standard& iso_2813() {
  static const Standard standard = load_standard(std::filesystem::path(GONIO_SOURCE_DIR) /
                                                 "standards/iso_2813/2014/standard.yaml");
  return standard;
}

/// A channel of gloss for each geometry, one instrument, one operator, the simple rule, and no rule
/// on readings. Of the first geometry these limits are required; acceptance: none may fail.
inline Batch batch_of(const Interval& limits, std::vector<std::string> geometries = {"60"}) {
  Batch batch{.id = "normal", .standard = iso_2813()};
  batch.standard.readings.reset();
  for (std::string& geometry : geometries) {
    batch.channels.push_back({.id = geometry, .geometry = std::move(geometry), .unit = "GU"});
  }
  if (limits.low || limits.high) {
    batch.requirements.push_back({.channel = 0, .limits = limits});
  }
  batch.plan = {.panels = 5, .positions = {{.x_mm = 30.0, .y_mm = 50.0}}};
  batch.instruments = {nominal_instrument(iso_2813())};
  batch.operators = {{.id = "anna"}};
  batch.decision.rule = DecisionRule::simple;
  return batch;
}

/// The same for all instruments and channels.
inline ReadingUncertainties uncertainties_of(const Batch& batch,
                                             const ReadingUncertainty& each = {}) {
  return ReadingUncertainties(batch.instruments.size() * batch.channels.size(), each);
}

/// Readings of channel 0, one at each position.
inline PanelRecord panel_of(std::uint64_t lot, std::uint64_t number,
                            const std::vector<double>& values) {
  PanelRecord panel{.number = number, .lot = lot};
  for (const double value : values) {
    panel.readings.push_back(
        {.position = std::uint32_t(panel.readings.size() + 1), .value = value});
  }
  return panel;
}

}  // namespace gonio::test

#pragma once

#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/reading_uncertainty.hpp"

namespace gonio::test {

/// A batch without a file: gloss at some geometries of ISO 2813, one nominal instrument, one
/// operator, panels of three readings, no limits.
inline Batch made_batch(const std::vector<std::string>& geometries) {
  Batch batch{.id = "made",
              .standard = load_standard(std::string(GONIO_SOURCE_DIR) +
                                        "/standards/iso_2813/2014/standard.yaml")};
  for (const std::string& geometry : geometries) {
    batch.channels.push_back({.id = geometry, .geometry = geometry, .unit = "GU"});
  }
  batch.colour_references.resize(batch.channels.size());
  batch.instruments = {nominal_instrument(batch.standard)};
  batch.operators = {{.id = "anna"}};
  batch.plan.positions = {{40.0, 50.0}, {75.0, 50.0}, {110.0, 50.0}};
  batch.decision.rule = DecisionRule::simple;
  return batch;
}

/// The same U for all instruments and channels, k = 2.
inline ReadingUncertainties same_uncertainty(const Batch& batch, double U) {
  return {batch.instruments.size() * batch.channels.size(), {.systematic = 0.5 * U, .expanded = U}};
}

/// A panel that was read with these values, channel by channel.
inline PanelRecord read_panel(const std::vector<std::vector<double>>& values,
                              std::uint64_t number = 1, std::uint64_t lot = 1) {
  PanelRecord panel{.number = number, .lot = lot};
  for (std::uint32_t c = 0; c < values.size(); ++c) {
    for (std::uint32_t i = 0; i < values[c].size(); ++i) {
      panel.readings.push_back({.channel = c, .position = i + 1, .value = values[c][i]});
    }
  }
  return panel;
}

}  // namespace gonio::test

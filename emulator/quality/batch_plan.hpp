#pragma once

#include <optional>

#include "emulator/quality/batch.hpp"

namespace gonio {

/// Where readings may be taken.
struct PanelSize {
  double length_mm = 0.0, width_mm = 0.0;
  /// How far positions that are not stated keep away from both ends: half the longest spot.
  double margin_mm = 0.0;
};

/// Reads the map `sampling` of a batch file; of nothing, what it is by default: one panel, read at
/// as many places as the reading rule asks for.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] SamplingPlan read_sampling(const std::optional<YamlNode>& node,
                                         const Standard& standard, const PanelSize& panel);

}  // namespace gonio

#pragma once

#include <map>
#include <optional>
#include <string>

#include "emulator/standard/standard.hpp"

// What a standard makes of gloss values, wherever they come from.

namespace gonio {

struct HazeResult {
  std::string id;
  std::optional<double> value;  ///< nothing where the standard does not define it
};

/// Haze by a rule of a standard: G(from) - G(minus), where both were read and G(from) is above the
/// rule's limit.
/// @param gloss_gu  by geometry.
[[nodiscard]] HazeResult haze(const HazeRule& rule, const std::map<std::string, double>& gloss_gu);

/// The value as the standard has it reported: to the nearest step of its `rounding`, a half away
/// from zero; as it is where the standard has no such rule.
[[nodiscard]] double reported_value(double gloss_gu, const Standard& standard);

}  // namespace gonio

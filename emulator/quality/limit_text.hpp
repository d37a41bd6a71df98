#pragma once

#include <optional>
#include <string>

#include "emulator/core/interval.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// Limits as people write them.
struct LimitText {
  Interval limits = {};
  std::optional<double> target = {};  ///< of limits on both sides of it
};

/// Reads `85 +- 3 GU` (or with the sign U+00B1), `82 to 88 GU`, `>= 80 GU` or `<= 10 GU`.
/// @param unit  that has to stand at the end, e.g. GU; empty for a number.
/// @throws InputError  for anything else, and for limits that leave no room between them.
[[nodiscard]] LimitText read_limit_text(const YamlNode& node, const std::string& unit);

}  // namespace gonio

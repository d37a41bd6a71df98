#pragma once

#include <string>

#include "emulator/core/angle.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// A number with its unit, as a case or a limit states it.
struct UnitValue {
  double value = 0.0;
  std::string unit = {};  ///< deg, GU, s, nm, K, or empty for a number
};

/// Reads a quantity of any dimension. @throws InputError  for what is none.
[[nodiscard]] UnitValue read_unit_value(const YamlNode& node);

/// An angle in degrees as it was stated: without the last bits that its way through radians leaves.
[[nodiscard]] double stated_degrees(Angle angle);

}  // namespace gonio

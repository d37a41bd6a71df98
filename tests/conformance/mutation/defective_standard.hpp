#pragma once

#include <functional>

#include "emulator/core/yaml_map.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio::conformance {

/// Makes a rule of a standard a wrong one.
using StandardDefect = std::function<void(Standard&)>;

/// Reads what is wrong with the rules by which readings are evaluated, e.g. {rounding: 5 GU}.
/// @throws InputError  for anything else.
[[nodiscard]] StandardDefect read_standard_defect(const YamlNode& node);

}  // namespace gonio::conformance

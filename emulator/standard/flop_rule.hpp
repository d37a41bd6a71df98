#pragma once

#include <string>

#include "emulator/core/yaml_map.hpp"
#include "emulator/standard/evidence.hpp"

namespace gonio {

/// How much darker a colour becomes away from the mirror direction, from the lightness L* in three
/// geometries:
///
///   flop = factor (L_near - L_far)^power / L_face^face_power
struct FlopRule {
  std::string near_specular, face, far;  ///< geometries
  Stated<double> factor, power, face_power;

  /// The weakest of its numbers.
  [[nodiscard]] Evidence evidence() const;
};

/// Reads the map `flop` of a standard.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] FlopRule read_flop_rule(const YamlNode& node);

}  // namespace gonio

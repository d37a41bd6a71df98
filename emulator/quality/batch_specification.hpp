#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"

namespace gonio {

/// What a batch has to keep, and so what is read.
struct Specification {
  std::vector<BatchChannel> channels = {};
  std::vector<Requirement> requirements = {};
  bool selected_only = false;
  std::vector<std::optional<std::array<double, 3>>> colour_references = {};
};

/// Reads the map `specification` of a batch file.
/// @param geometries  the list `measuring.geometries`: what is read; nothing: what is needed.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Specification read_specification(const YamlNode& node, const Standard& standard,
                                               const std::optional<YamlNode>& geometries);

/// The id of a geometry, which a key may write with its unit: `60` and `60 deg` are the
/// geometry 60.
[[nodiscard]] std::string geometry_of(const std::string& key);

}  // namespace gonio

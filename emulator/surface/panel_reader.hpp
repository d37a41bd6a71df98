#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/surface/coating.hpp"
#include "emulator/surface/panel_layout.hpp"

namespace gonio {

/// What a sample file says of surfaces and places.
struct PanelStatement {
  std::vector<Coating> coatings;                   ///< by region, one at least
  std::shared_ptr<const PanelLayout> layout = {};  ///< null without `panel:`
};

/// Reads one of `surface:`, `lobes:` and `regions:`, then `panel:` and `maps:`.
///
///     panel: {length: 150 mm, width: 100 mm}
///     regions:
///       - {id: base, surface: {...}}
///       - {id: stripe, rectangle: {centre: [75 mm, 50 mm], length: 20 mm, width: 100 mm},
///          surface: {...}}
///       - {id: spot, ellipse: {centre: [20 mm, 20 mm], length: 8 mm, width: 8 mm}, lobes: [...]}
///     maps:
///       roughness: {file: orange_peel.png, black: -0.1, white: 0.1}
///       diffuse_reflectance: {file: grid.csv}
///
/// @throws InputError  for anything else, also in the files that it names, and for maps that lead
///                     out of the range of a model.
[[nodiscard]] PanelStatement read_panel_statement(YamlMap& map, const WavelengthGrid& grid);

}  // namespace gonio

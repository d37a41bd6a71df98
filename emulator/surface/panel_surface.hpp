#pragma once

#include <memory>
#include <vector>

#include "emulator/surface/coating.hpp"
#include "emulator/surface/panel_layout.hpp"

namespace gonio {

/// The surface of a panel that is not the same everywhere. Light from different places adds up, so
/// that an area reflects as the mixture of what it covers. Cheap to copy.
struct PanelSurface {
  std::shared_ptr<const PanelLayout> layout;
  std::vector<Coating> coatings;   ///< by region
  SampleDeviation deviation = {};  ///< of all of the panel, besides those of its maps

  /// The mixture of these shares. @throws std::domain_error  as Coating::surface.
  [[nodiscard]] Surface mixed(const std::vector<SpotShare>& shares) const;
};

}  // namespace gonio

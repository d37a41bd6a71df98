#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "emulator/surface/outline.hpp"
#include "emulator/surface/parameter_map.hpp"
#include "emulator/surface/sample_deviation.hpp"
#include "emulator/surface/spot.hpp"

namespace gonio {

/// A panel that is not the same everywhere: which region lies where, and how parameters deviate
/// from place to place. The origin is a corner, x runs along the plane of measurement.
struct PanelLayout {
  struct Region {
    std::string id;
    std::optional<Outline> outline = {};  ///< nothing: all of the panel
  };
  double length_mm = 0.0, width_mm = 0.0;  ///< along x and along y
  /// At least one; later ones lie over earlier ones, and the first covers the panel.
  std::vector<Region> regions = {};
  std::array<std::optional<ParameterMap>, sample_parameter_count> maps =
      {};  ///< by SampleParameter

  /// @return  whether all of the spot lies on the panel.
  [[nodiscard]] bool carries(const Spot& spot) const;
  [[nodiscard]] Outline outline() const;
  [[nodiscard]] bool has_maps() const;
};

/// A part of what is averaged that is the same everywhere.
struct SpotShare {
  std::size_t region = 0;
  SampleDeviation deviation = {};
  double weight = 0.0;  ///< share of the area
};

/// What a spot covers of a panel. Values of maps are put together where they are alike: the mean of
/// each of at most 64 groups in a region, so that what depends on them is right to the square of
/// their spread in a group.
///
/// Areas are right to 1e-3 of that of the spot; values of maps are taken at points twice as dense
/// as the cells of the map, but at most 512 x 512.
/// @return  weights of sum 1, over the part of the spot that lies on the panel.
/// @throws std::domain_error  if no part of the spot lies on the panel.
[[nodiscard]] std::vector<SpotShare> shares(const PanelLayout& layout, const Spot& spot);
/// The same of all the panel.
[[nodiscard]] std::vector<SpotShare> shares(const PanelLayout& layout);

}  // namespace gonio

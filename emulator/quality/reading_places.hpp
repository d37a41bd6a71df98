#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/surface/panel_layout.hpp"
#include "emulator/surface/sample_family.hpp"

namespace gonio {

/// Where one instrument reads panels: position by position, the further ones too, and in each of
/// them channel by channel of those that are read.
struct ReadingPlaces {
  std::vector<std::vector<SpotShare>> shares = {};  ///< what the spot covers
  /// Times independent normal numbers: what each spot averages of a film whose variance is 1 and
  /// whose correlation is exp(-d^2 / 2 L^2). Shape (n_places, n_places).
  Eigen::MatrixXd film = {};
};

/// @param channels  that are read: gloss and colours.
/// @throws InputError  for a position where a spot hangs over the edge of the panel.
[[nodiscard]] ReadingPlaces reading_places(const Batch& batch, const Instrument& instrument,
                                           const std::vector<std::uint32_t>& channels,
                                           const SampleFamily& family);

/// What all of a panel consists of.
[[nodiscard]] std::vector<SpotShare> shares_of_panel(const SampleFamily& family);

}  // namespace gonio

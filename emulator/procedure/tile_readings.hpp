#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"

namespace gonio {

/// A reading of a reference tile.
struct TileReading {
  std::string sample;    ///< a file or an id
  std::string geometry;  ///< id
  double gloss_gu = 0.0;
  std::optional<double> expanded_uncertainty_gu = {};  ///< k = 2; nothing: of the instrument
  SourceMark mark = {};                                ///< of the sample
  SourceMark geometry_mark = {};
};

/// Reads a CSV file with the columns `sample`, `geometry`, `gloss_gu` and, if some readings have
/// an uncertainty of their own, `expanded_uncertainty_gu`, in any order; an empty cell of the last
/// one is none. A reading may be repeated; comments begin with `#`.
/// @throws InputError  for anything else, with line and column.
[[nodiscard]] std::vector<TileReading> load_tile_readings(const std::filesystem::path& file);

}  // namespace gonio

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "emulator/core/angle.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/surface/panel_surface.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// A sample from a file: what it is called, its surface on a wavelength grid, and how it lies.
struct Sample {
  std::filesystem::path file;
  std::string id = {};
  std::string title = {};
  std::string notes = {};
  Surface surface;  ///< of a panel that is not the same everywhere: its mean over the panel
  /// In the plane of measurement, towards the receptor: the wedge that it lies on.
  Angle tilt = {};
  /// What lies where; nothing if the file states no panel.
  std::optional<PanelSurface> panel = {};
};

/// Reads a file of schema gonio/sample/1.
/// @param grid  the wavelengths of the measurement; every spectrum of the sample must cover it.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Sample load_sample(const std::filesystem::path& path, const WavelengthGrid& grid);

}  // namespace gonio

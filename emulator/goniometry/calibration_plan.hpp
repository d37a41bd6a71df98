#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/goniometry/setup_grid.hpp"

namespace gonio {

/// How an instrument is calibrated, from a file of schema gonio/calibration/1.
struct CalibrationPlan {
  std::string id, title;
  std::filesystem::path instrument = {};     ///< its file
  std::filesystem::path sample = {};         ///< its file
  std::vector<std::string> geometries = {};  ///< ids; empty for all that are measured
  MirrorReference reference = MirrorReference::source;
  std::optional<int> patches = {};     ///< integrator of the set-up as built; nothing: by
                                       ///< aperture
  GridAxes grid = {};                  ///< empty axes: no grid
  std::vector<std::string> free = {};  ///< names for setup_parameters
};

/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] CalibrationPlan load_calibration_plan(const std::filesystem::path& path,
                                                    const Catalog& catalog);

/// The file of a plan: an id among the shipped ones, or an existing path.
/// @throws InputError  if there is none.
[[nodiscard]] std::filesystem::path find_calibration_plan(const std::string& id_or_path,
                                                          const Catalog& catalog);

/// The grid round an instrument that a calibration tries where no plan says otherwise: angles 0.5
/// deg to both sides, diameters 1 deg to both sides of what its first geometry has, 0.5 deg apart,
/// and 768 to 786,432 patches.
[[nodiscard]] GridAxes usual_grid(const Instrument& instrument, const std::string& geometry);

}  // namespace gonio

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/goniometry/setup_calibration.hpp"
#include "emulator/goniometry/setup_grid.hpp"

namespace gonio {

/// What came of the calibration of a set-up.
struct CalibrationReport {
  std::string instrument;  ///< id
  MirrorReference reference = MirrorReference::source;
  std::vector<std::string> measured = {};  ///< e.g. "black_glass_n1567 at 20, 60 from spectra.csv"
  std::optional<SetupGrid> grid = {};
  std::optional<SetupCalibration> fit = {};
  std::vector<OtherSetup> others = {};
  std::string version = {};  ///< of gonio
};

/// For a terminal.
[[nodiscard]] std::string calibration_text(const CalibrationReport& report, bool styled);
/// Schema gonio/setup_calibration/1: everything, numbers at full precision.
[[nodiscard]] std::string calibration_json(const CalibrationReport& report);
/// A page of its own: measured and simulated spectra as in [Mihalik] Figure 10, residuals, the map
/// of RMSE over the grid, the confidence ellipse; charts inside, no network needed.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string calibration_page(const CalibrationReport& report);

}  // namespace gonio

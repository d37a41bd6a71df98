#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/goniometry/setup_model.hpp"

namespace gonio {

/// The set-ups that are tried, each with each: [Mihalik] section 7.1.
struct GridAxes {
  std::vector<Angle> angle_offsets = {};  ///< added to theta_i and theta_r of all geometries
  std::vector<Angle> sources = {};        ///< diameters; openings become circles
  std::vector<Angle> receptors = {};
  /// Numbers of patches on the hemisphere, 3 N^2, each beside the integrator by aperture.
  std::vector<int> patches = {};
};

/// One set-up, and how far its spectra are from the measured ones.
struct GridRow {
  Angle angle_offset = {}, source = {}, receptor = {};
  std::optional<int> patches = {};  ///< nothing: by aperture
  double rmse = 0.0;                ///< over all values of all spectra; infinite without an answer
  double relative_rmse = 0.0;       ///< over the root mean square of the measured
};

struct SetupGrid {
  GridRow as_built = {};           ///< with the integrator of the plan; sizes of the first geometry
  std::vector<GridRow> rows = {};  ///< in the order of the axes, the integrator changing fastest

  /// The row of the smallest RMSE; of equal ones the first.
  /// @param patches  of one integrator alone; nothing: by aperture.
  [[nodiscard]] const GridRow& best(std::optional<int> patches) const;
  [[nodiscard]] const GridRow& best() const;
};

/// What the grid shows, as the paper puts it.
struct GridFindings {
  /// The smallest RMSE by aperture with a receptor at least as large as the source, and with a
  /// smaller one; infinite where there is none.
  double receptor_at_least_source = 0.0, receptor_smaller = 0.0;
  /// Rows by aperture that are as good as the best to a hundredth: the grid does not tell them
  /// apart.
  std::size_t as_good = 0;
  struct BySubdivision {
    std::optional<int> patches = {};  ///< nothing: by aperture
    double at_best = 0.0;             ///< RMSE of the set-up that is best by aperture
    double smallest = 0.0;            ///< RMSE of the best set-up with this subdivision
  };
  std::vector<BySubdivision> subdivisions = {};  ///< coarse to fine, the last by aperture
  /// The fewest patches from which on further ones change the RMSE at the best set-up by no more
  /// than a hundredth of it; nothing if there are none.
  std::optional<int> enough_patches = {};
};

/// N of a hemisphere of 3 N^2 patches; nothing unless N is a multiple of 4 in [4, 4096].
[[nodiscard]] std::optional<int> patch_resolution(int patches);

/// The relative RMSE of Table 1 beside the RMSE of section 7.1 for each set-up of the grid.
/// @param model    its parameters do not matter, its integrator neither.
/// @param patches  of the integrator of the set-up as built; nothing: by aperture.
/// @param advance  called once after each set-up, from any thread, one at a time.
/// @throws std::invalid_argument  for an axis without values, or a number that is not 3 N^2.
[[nodiscard]] SetupGrid try_grid(const SetupModel& model, const GridAxes& axes,
                                 std::optional<int> patches,
                                 const std::function<void()>& advance = {});
/// How many set-ups that are, without that as built.
[[nodiscard]] std::size_t size_of(const GridAxes& axes);

[[nodiscard]] GridFindings findings_of(const SetupGrid& grid);

/// The instrument with the set-up of a row.
[[nodiscard]] Instrument with_setup(Instrument instrument,
                                    const std::vector<std::string>& geometries, const GridRow& row);

}  // namespace gonio

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/instrument/setup.hpp"
#include "emulator/procedure/prior_fit.hpp"
#include "emulator/procedure/tile_readings.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// A parameter of a set-up, as the readings tell it.
struct EstimatedParameter {
  std::string name;                ///< of SetupQuantity, or reference_value (relative), zero (GU)
  std::string unit;                ///< deg, GU, or empty
  double assumed = 0.0;            ///< where the search began: as built
  double prior_uncertainty = 0.0;  ///< standard; what was assumed of it before
  double estimate = 0.0;
  double standard_uncertainty = 0.0;
  bool is_determined = false;  ///< the readings tell at least half of what was not known
};

/// What the readings of one geometry tell of its set-up.
struct SetupEstimate {
  std::string geometry;
  std::vector<EstimatedParameter> parameters = {};
  std::vector<std::vector<double>> correlation = {};  ///< of the estimates
  std::vector<Confusion> confusions = {};             ///< the least known first
  std::vector<double> residual_gu = {};               ///< by reading: found - expected
  std::vector<TileReading> readings = {};
  double chi_squared = 0.0;  ///< of readings and priors
  std::size_t degrees_of_freedom = 0;
  double p_value = 0.0;  ///< that chi squared is at least so large if the model holds
  bool has_converged = false;
};

struct SetupEstimateOptions {
  /// Prior standard uncertainty of each quantity of the set-up, in tolerances of the standard; of
  /// 0.1 deg where it states none.
  double prior_tolerances = 3.0;
  double prior_reference_value = 0.01;  ///< relative
  double prior_zero_gu = 0.2;
  double tolerance = 1e-6;  ///< asked of the integrator, in GU
};

/// The set-up that explains readings of reference tiles best: Levenberg-Marquardt on readings and
/// priors together, so that what the readings do not tell stays as it was assumed, and as
/// uncertain.
///
/// Uncertainties follow from derivatives at the estimate. They hold for deviations of about a
/// tolerance; over several of them readings bend, most of all where the image of the source comes
/// to the edge of the receptor, and the estimate may miss by more than it says. A small p value
/// tells of readings that no set-up near the one assumed explains.
///
/// @param tiles  the samples of the readings, in their order, on one wavelength grid.
/// @throws InputError             for a reading of a geometry that the instrument does not have, or
///                                whose uncertainty nobody states; for an aperture of unknown size
///                                that is not stated as built.
/// @throws std::invalid_argument  for other than one tile for each reading.
/// @return  one for each geometry that was read, in the instrument's order.
[[nodiscard]] std::vector<SetupEstimate> estimate_setup(const Instrument& instrument,
                                                        const std::vector<TileReading>& readings,
                                                        const std::vector<Sample>& tiles,
                                                        const SetupEstimateOptions& options);

}  // namespace gonio

#pragma once

#include <cstddef>
#include <vector>

#include "emulator/goniometry/surface_fit.hpp"

namespace gonio {

/// How a model stands among others.
struct RankedFit {
  std::size_t fit = 0;  ///< its place among the fits
  double aicc = 0.0;
  double bic = 0.0;
  double weight = 0.0;  ///< of Akaike, by AICc; the sum over all models is 1
};

/// Models fitted to the same observations.
struct FitComparison {
  std::vector<RankedFit> ranking = {};  ///< by AICc, the best first
  /// Correlation of neighbouring residuals of the best of all fits, and how many independent
  /// observations there are by it.
  double autocorrelation = 0.0;
  double effective_size = 0.0;
};

/// Compares fits by AICc and BIC:
///
///   AICc = -2 ln L + 2 k + 2 k (k + 1) / (n_eff - k - 1),   BIC = -2 ln L + k ln n_eff,
///
/// -2 ln L = chi^2 n_eff / n where uncertainties are known, else n_eff ln(chi^2 / n), and k counts
/// the common uncertainty too. Neighbouring observations are not independent where the residuals
/// of the best fit are correlated; n_eff is what they are worth, the same for all models, because
/// a model that is wrong correlates its own residuals.
/// @param fits  of the same observations, at least one.
/// @throws std::invalid_argument  if not so.
/// @see Burnham and Anderson, Model Selection and Multimodel Inference (2002)
[[nodiscard]] FitComparison compare_fits(const std::vector<SurfaceFit>& fits, bool is_u_known);

}  // namespace gonio

#include "emulator/goniometry/fit_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "emulator/goniometry/fit_uncertainty.hpp"

namespace gonio {

namespace {

/// What of n observations is independent cannot be fewer: AICc has no value then.
double least_size(const std::vector<SurfaceFit>& fits) {
  int most = 0;
  for (const SurfaceFit& fit : fits) {
    most = std::max(most, fit.sought);
  }
  return double(most + 1 + 2);
}

}  // namespace

FitComparison compare_fits(const std::vector<SurfaceFit>& fits, bool is_u_known) {
  if (fits.empty() || !std::ranges::all_of(fits, [&](const SurfaceFit& fit) {
        return fit.residual.size() == fits.front().residual.size();
      })) {
    throw std::invalid_argument("compare_fits: fits of the same observations");
  }
  const double n = double(fits.front().residual.size());
  const SurfaceFit& nearest = *std::ranges::min_element(fits, {}, &SurfaceFit::chi_squared);
  FitComparison made{.autocorrelation = nearest.autocorrelation};
  made.effective_size = std::max(effective_size(n, made.autocorrelation), least_size(fits));
  const double n_eff = made.effective_size;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    // Of a fit that is exact the logarithm is not.
    const double chi_squared =
        std::max(fits[i].chi_squared, n * std::numeric_limits<double>::epsilon() *
                                          std::numeric_limits<double>::epsilon());
    const double deviance =
        is_u_known ? chi_squared * n_eff / n : n_eff * std::log(chi_squared / n);
    const double k = double(fits[i].sought) + (is_u_known ? 0.0 : 1.0);
    made.ranking.push_back({.fit = i,
                            .aicc = deviance + 2.0 * k + 2.0 * k * (k + 1.0) / (n_eff - k - 1.0),
                            .bic = deviance + k * std::log(n_eff)});
  }
  std::ranges::stable_sort(made.ranking, {}, &RankedFit::aicc);
  double sum = 0.0;
  for (RankedFit& ranked : made.ranking) {
    ranked.weight = std::exp(-0.5 * (ranked.aicc - made.ranking.front().aicc));
    sum += ranked.weight;
  }
  for (RankedFit& ranked : made.ranking) {
    ranked.weight /= sum;
  }
  return made;
}

}  // namespace gonio

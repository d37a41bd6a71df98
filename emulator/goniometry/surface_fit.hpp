#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator/goniometry/fit_model.hpp"
#include "emulator/goniometry/fit_observations.hpp"
#include "emulator/goniometry/model_responses.hpp"

namespace gonio {

/// A parameter after a fit.
struct FittedParameter {
  enum class State {
    free,
    fixed,     ///< by who asked for the fit
    at_bound,  ///< of its range, or of k_d + k_s <= 1 alone; nothing is said of its uncertainty
    open       ///< the observations do not tell it from others
  };

  std::string name;
  double value = 0.0;
  State state = State::free;
  double u = 0.0;                ///< standard uncertainty; infinite if open, else 0 if not free
  double low = 0.0, high = 0.0;  ///< of an interval that covers 95 %
};

/// How near a fit comes to one group of observations.
struct FitDeviation {
  std::string group;
  double rmse = 0.0;
  double relative_rmse = 0.0;  ///< rmse over the mean of what was observed, as in Table 1
};

/// A model fitted to observations.
struct SurfaceFit {
  std::string model, title;
  std::vector<FittedParameter> parameters = {};
  /// Correlations of the parameters that are free, in their order, shape (n_free, n_free).
  Eigen::MatrixXd correlation = {};
  Eigen::VectorXd fitted = {};    ///< shape (n)
  Eigen::VectorXd residual = {};  ///< (observed - fitted) / u, shape (n)
  double chi_squared = 0.0;       ///< sum of squared residuals
  int sought = 0;                 ///< number of parameters that were not fixed
  /// What an uncertainty is in units of u: 1 if u is known, else estimated.
  double sigma = 1.0;
  double p_value = 1.0;          ///< of chi squared, if u is known
  double autocorrelation = 0.0;  ///< of neighbouring residuals
  double effective_size = 0.0;   ///< of independent observations, <= n
  std::vector<FitDeviation> deviations = {};
  bool has_converged = false;

  [[nodiscard]] FitValues values() const;
  [[nodiscard]] const FittedParameter& parameter(const std::string& name) const;
};

/// Fits a model by least squares of (observed - fitted) / u.
///
/// Slopes and other shapes are searched by Levenberg and Marquardt from the best of all starts;
/// for each shape the amplitudes are solved for, within >= 0 and a sum <= 1, so that no search has
/// to cross their bounds. Where neighbouring residuals are correlated, n observations count as
/// n (1 - r) / (1 + r).
/// @param n_hat  of the material, on the grid of the observations.
/// @param fixed  parameters that keep a value; names of other models are passed over.
/// @throws std::invalid_argument  for fewer observations than parameters, or a fixed value outside
///                                its range.
/// @see Golub and Pereyra, SIAM J. Numer. Anal. 10, 413 (1973)
[[nodiscard]] SurfaceFit fit_surface(const FitObservations& observations,
                                     const FittableModel& model, const Eigen::ArrayXcd& n_hat,
                                     const FitValues& fixed = {});
/// The same with responses that were computed before: of the same directions or geometries, in the
/// same order.
[[nodiscard]] SurfaceFit fit_surface(const FitObservations& observations, ModelResponses& responses,
                                     const FitValues& fixed = {});

}  // namespace gonio

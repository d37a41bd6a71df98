#pragma once

#include <Eigen/Core>

#include "emulator/goniometry/surface_fit.hpp"

namespace gonio {

/// How observations answer to parameters at a fit.
struct FitSensitivity {
  /// Directions in which parameters are free, shape (p, n_free), in the order of the model.
  Eigen::MatrixXd directions;
  /// Derivatives of the responses in units of u along them, shape (n, n_free).
  Eigen::MatrixXd derivatives = {};
};

/// Completes a fit, which has its values, residuals and chi squared: what is known of each
/// parameter, from the covariance s^2 (J' J)^-1 n / n_eff, s = 1 where u is known.
void state_uncertainty(SurfaceFit& fit, const FitObservations& observations,
                       const FittableModel& model, const FitSensitivity& sensitivity);

/// Correlation of neighbouring residuals, over all groups; 0 if it is within what chance gives
/// independent ones, 2 / sqrt(n), or negative.
[[nodiscard]] double autocorrelation_of(const Eigen::VectorXd& residual,
                                        const std::vector<FitGroup>& groups);
/// n (1 - r) / (1 + r), of n observations whose neighbours are correlated by r in [0, 1).
[[nodiscard]] double effective_size(double n, double r);

}  // namespace gonio

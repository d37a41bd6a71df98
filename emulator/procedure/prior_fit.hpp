#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace gonio {

/// Observations of a model of n values and p parameters, and what was known of its parameters
/// before. All errors are normal and independent.
struct PriorFitProblem {
  using Vector = Eigen::VectorXd;

  /// Shape (p) to (n); infinite where the model has no answer.
  std::function<Vector(const Vector&)> model;
  /// Derivatives of the model, shape (p) to (n, p). May be dear: it is asked for a few times.
  std::function<Eigen::MatrixXd(const Vector&)> jacobian;
  Vector observed, u_observed;       ///< shape (n), u > 0: standard uncertainties
  Vector assumed, u_assumed;         ///< shape (p), u > 0
  Eigen::MatrixXd jacobian_assumed;  ///< at what was assumed, shape (n, p)
};

/// A combination of parameters that observations leave open.
struct Confusion {
  std::vector<double> direction = {};  ///< by parameter, in units of its prior uncertainty; norm 1
  double remaining = 0.0;              ///< share of the prior uncertainty that is left, in (0, 1]
};

/// The parameters that are most probable after the observations.
struct PriorFit {
  Eigen::VectorXd estimate;    ///< shape (p)
  Eigen::MatrixXd covariance;  ///< of the estimate, shape (p, p), by the derivatives there
  Eigen::VectorXd residual;    ///< observed - model, shape (n)
  double chi_squared = 0.0;    ///< of observations and priors: n degrees of freedom
  double p_value = 0.0;        ///< that chi squared is at least so large if the model holds
  bool has_converged = false;
};

/// Minimises the sum of squares of (observed - model) / u and (parameter - assumed) / u by
/// Levenberg-Marquardt from what was assumed, in rounds: each begins with the derivatives where it
/// starts, and corrects them by what its steps show, until a round gains nothing that counts.
/// @see Broyden, Mathematics of Computation 19, 577 (1965) for the correction
/// @throws std::invalid_argument  for shapes that do not fit, or an uncertainty that is not > 0.
[[nodiscard]] PriorFit fit_with_prior(const PriorFitProblem& problem);

/// The directions, at right angles in units of the prior uncertainty, in which more than half of it
/// is left; the least known first. Parameters that are equally unknown are named one by one.
/// @param covariance  after the observations, shape (p, p).
/// @param prior       standard uncertainties, shape (p).
[[nodiscard]] std::vector<Confusion> confusions_of(const Eigen::MatrixXd& covariance,
                                                   const Eigen::VectorXd& prior);

}  // namespace gonio

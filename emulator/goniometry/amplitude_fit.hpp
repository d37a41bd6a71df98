#pragma once

#include <Eigen/Core>

namespace gonio {

/// Amplitudes of least squares.
struct AmplitudeFit {
  Eigen::VectorXd amplitudes;  ///< >= 0, of sum <= limit; shape (p)
  /// Directions in which they may change without leaving a bound that holds them, orthonormal;
  /// shape (p, n_free).
  Eigen::MatrixXd free = {};
  double sum_of_squares = 0.0;
};

/// Minimises |observed - terms k|^2 over k >= 0 with a sum <= limit, exactly: tries all sets of
/// bounds. @param terms  shape (n, p), p <= 8.   @param limit  >= 0.
[[nodiscard]] AmplitudeFit fit_amplitudes(const Eigen::MatrixXd& terms,
                                          const Eigen::VectorXd& observed, double limit);

}  // namespace gonio

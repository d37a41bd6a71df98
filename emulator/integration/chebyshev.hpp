#pragma once

#include <Eigen/Core>

#include "emulator/surface/surface.hpp"

namespace gonio {

/// The Chebyshev points of the second kind, cos(pi j / (n - 1)), ascending; shape (n), n >= 2.
[[nodiscard]] Eigen::ArrayXd chebyshev_points(Eigen::Index n);

/// Weights L_j(x) of polynomial interpolation from values at chebyshev_points(n) to points x.
/// @return  shape (x.size(), n); its rows sum to 1.
[[nodiscard]] Eigen::MatrixXd chebyshev_interpolation(Eigen::Index n, const Eigen::ArrayXd& x);

/// The colour of a lobe as a Chebyshev series in cos theta_d, so that one set of moments of the
/// geometry serves all wavelengths:
///
///   s(cos theta_d, lambda) = sum_k coefficient(k, lambda) T_k(scale * cos theta_d + shift).
struct ColourSeries {
  double scale = 0.0;
  double shift = 0.0;
  Eigen::MatrixXd coefficient;  ///< shape (n_k, n_lambda)
  Eigen::ArrayXd truncation;    ///< estimate of what the series leaves out, shape (n_lambda)

  /// @param low, high  the cosines that occur, 0 <= low < high <= 1.
  /// @param accuracy   asked for, absolute.
  ColourSeries(const Colour& colour, double low, double high, double accuracy);
};

}  // namespace gonio

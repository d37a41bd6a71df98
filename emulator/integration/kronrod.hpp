#pragma once

#include <Eigen/Core>

namespace gonio {

/// Gauss's rule of n points and Kronrod's extension of it to 2n + 1, on [-1, 1].
/// Exact for polynomials up to degree 2n - 1 and 3n + 1.
struct KronrodRule {
  Eigen::ArrayXd node;     ///< ascending, shape (2n + 1)
  Eigen::ArrayXd kronrod;  ///< weights, sum 2
  Eigen::ArrayXd gauss;    ///< weights, sum 2; zero at the nodes that Kronrod added
};

/// @param n  number of Gauss points, >= 1; a rule is computed once and kept.
/// @throws std::domain_error  if n < 1.
/// @see    Laurie, Math. Comp. 66, 1133 (1997); Golub and Welsch, Math. Comp. 23, 221 (1969)
[[nodiscard]] const KronrodRule& kronrod_rule(int n);

}  // namespace gonio

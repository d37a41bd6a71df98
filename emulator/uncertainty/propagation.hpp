#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "emulator/uncertainty/input_set.hpp"

namespace gonio {

/// What one input contributes to the uncertainty of an output.
struct Contribution {
  std::size_t input = 0;
  double sensitivity = 0.0;  ///< change of the output per unit of the input
  double contribution =
      0.0;  ///< |sensitivity| times standard uncertainty, in the unit of the output
  /// Of the variance of the output; all of them have the sum 1. With correlations it may be
  /// negative.
  double share = 0.0;
};

/// The uncertainty of an output by the law of propagation.
struct Propagated {
  double standard_uncertainty = 0.0;
  double degrees_of_freedom = 0.0;  ///< effective, by Welch and Satterthwaite; infinite if all are
  double coverage_factor = 0.0;
  double expanded_uncertainty = 0.0;
  std::vector<Contribution> budget = {};  ///< in the order of the inputs
};

/// u^2 = sum_ij c_i c_j r_ij u_i u_j.
///
/// @param sensitivity  c, shape (inputs.size()).
/// @param coverage     of the expanded uncertainty, in (0, 1).
/// @throws std::invalid_argument  for sensitivities that are not finite or not as many.
/// @throws std::domain_error      if the correlation matrix is not positive definite, so that a
///                                variance could be negative.
/// @see    JCGM 100:2008, 5.1, 5.2, G.4
[[nodiscard]] Propagated propagate(const InputSet& inputs, const Eigen::VectorXd& sensitivity,
                                   double coverage = 0.95);

}  // namespace gonio

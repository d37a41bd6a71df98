#pragma once

#include <vector>

namespace gonio {

/// What an integral over a normal distribution is the weighted sum of.
struct NormalNode {
  double x = 0.0, weight = 0.0;
};

/// Nodes for the mean of f(x), x normal of mean 0, where f is smooth but near some places.
///
///   E[f(x)] = sum weight_i f(x_i)
///
/// By Gauss' rule between all ends of pieces; right to 1e-9 for f in [0, 1] that changes like a
/// normal distribution function.
/// @param sd      >= 0; with 0 there is one node.
/// @param places  where f changes.   @param scale  within which it does, >= 0: with 0 it jumps.
[[nodiscard]] std::vector<NormalNode> normal_nodes(double sd, const std::vector<double>& places,
                                                   double scale);

}  // namespace gonio

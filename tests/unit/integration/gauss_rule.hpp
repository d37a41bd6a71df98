#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace gonio::test {

/// Gauss's rule of n points on [-1, 1], by Newton's method on the Legendre polynomial: an
/// independent way to the nodes and weights.
struct GaussRule {
  Eigen::ArrayXd node, weight;

  explicit GaussRule(Eigen::Index n) : node(n), weight(n) {
    for (Eigen::Index i = 0; i < n; ++i) {
      double x = -std::cos(std::numbers::pi * (double(i) + 0.75) / (double(n) + 0.5));
      double slope = 0.0;
      for (int step = 0; step < 8; ++step) {
        double before = 1.0;
        double p = x;
        for (Eigen::Index k = 2; k <= n; ++k) {
          const double next = (double(2 * k - 1) * x * p - double(k - 1) * before) / double(k);
          before = p;
          p = next;
        }
        slope = double(n) * (x * p - before) / (x * x - 1.0);
        x -= p / slope;
      }
      node(i) = x;
      weight(i) = 2.0 / ((1.0 - x * x) * slope * slope);
    }
  }

  /// int_low^high f(x) dx
  template <class Function>
  [[nodiscard]] double integral(double low, double high, Function f) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < node.size(); ++i) {
      sum += weight(i) * f(0.5 * (low + high) + 0.5 * (high - low) * node(i));
    }
    return 0.5 * (high - low) * sum;
  }
};

}  // namespace gonio::test

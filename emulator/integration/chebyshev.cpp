#include "emulator/integration/chebyshev.hpp"

#include <cmath>
#include <numbers>

namespace gonio {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using std::numbers::pi;

namespace {

constexpr Index most_terms = 128;
constexpr double rounding = 1e-15;  // of a coefficient, relative to the largest

/// Values at the n zeros of T_n to coefficients, shape (n, n).
MatrixXd to_coefficients(Index n) {
  MatrixXd transform(n, n);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < n; ++j) {
      transform(k, j) = (k == 0 ? 1.0 : 2.0) / double(n) *
                        std::cos(pi * double(k) * (double(j) + 0.5) / double(n));
    }
  }
  return transform;
}

}  // namespace

ArrayXd chebyshev_points(Index n) {
  return -(ArrayXd::LinSpaced(n, 0.0, double(n - 1)) * (pi / double(n - 1))).cos();
}

MatrixXd chebyshev_interpolation(Index n, const ArrayXd& x) {
  const ArrayXd node = chebyshev_points(n);
  MatrixXd weight(x.size(), n);
  for (Index i = 0; i < x.size(); ++i) {
    Index hit = -1;
    for (Index j = 0; j < n; ++j) {  // barycentric formula
      const double sign = j % 2 == 0 ? 1.0 : -1.0;
      const double gap = x(i) - node(j);
      if (gap == 0.0) {
        hit = j;
      }
      weight(i, j) = sign * (j == 0 || j == n - 1 ? 0.5 : 1.0) / (gap == 0.0 ? 1.0 : gap);
    }
    if (hit >= 0) {
      weight.row(i).setZero();
      weight(i, hit) = 1.0;
    }
    weight.row(i) /= weight.row(i).sum();
  }
  return weight;
}

ColourSeries::ColourSeries(const Colour& colour, double low, double high, double accuracy)
    : scale(2.0 / (high - low)), shift(-(high + low) / (high - low)) {
  for (Index n = 6;; n *= 2) {
    MatrixXd value;
    for (Index j = 0; j < n; ++j) {
      const double x = std::cos(pi * (double(j) + 0.5) / double(n));
      const ArrayXd s = colour((x - shift) / scale);
      if (j == 0) {
        value.resize(n, s.size());
      }
      value.row(j) = s.matrix().transpose();
    }
    coefficient = to_coefficients(n) * value;
    // The last two coefficients say how fast the series falls.
    truncation = coefficient.bottomRows(2).cwiseAbs().colwise().sum().transpose().array();
    if (truncation.maxCoeff() <= std::max(accuracy, rounding * coefficient.cwiseAbs().maxCoeff()) ||
        n > most_terms / 2) {
      Index used = n;
      while (used > 1 && coefficient.row(used - 1).cwiseAbs().maxCoeff() <= 0.1 * accuracy) {
        --used;
      }
      const MatrixXd head = coefficient.topRows(used);
      truncation += coefficient.bottomRows(n - used).cwiseAbs().colwise().sum().transpose().array();
      coefficient = head;
      return;
    }
  }
}

}  // namespace gonio

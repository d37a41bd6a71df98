#include "emulator/integration/kronrod.hpp"

#include <Eigen/Eigenvalues>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// b_0 = 2, b_k = k^2 / (4 k^2 - 1): recurrence of the Legendre polynomials (all a_k are 0).
double legendre_b(Index k) {
  const double k2 = double(k) * double(k);
  return k == 0 ? 2.0 : k2 / (4.0 * k2 - 1.0);
}

/// Laurie's algorithm for a symmetric weight: b_0 .. b_2n of the Jacobi-Kronrod matrix.
VectorXd jacobi_kronrod(Index n) {
  VectorXd b = VectorXd::Zero(2 * n + 1);
  for (Index k = 0; k <= (3 * n + 1) / 2; ++k) {
    b(k) = legendre_b(k);
  }
  VectorXd s = VectorXd::Zero(n / 2 + 2);
  VectorXd t = VectorXd::Zero(n / 2 + 2);
  t(1) = b(n + 1);
  for (Index m = 0; m <= n - 2; ++m) {
    double sum = 0.0;
    for (Index k = (m + 1) / 2; k >= 0; --k) {
      sum += b(k + n + 1) * s(k) - b(m - k) * s(k + 1);
      s(k + 1) = sum;
    }
    std::swap(s, t);
  }
  for (Index j = n / 2; j >= 0; --j) {
    s(j + 1) = s(j);
  }
  for (Index m = n - 1; m <= 2 * n - 3; ++m) {
    double sum = 0.0;
    Index j = 0;
    for (Index k = m + 1 - n; k <= (m - 1) / 2; ++k) {
      j = n - 1 - (m - k);
      sum += -b(k + n + 1) * s(j + 1) + b(m - k) * s(j + 2);
      s(j + 1) = sum;
    }
    if (m % 2 != 0) {
      b((m + 1) / 2 + n + 1) = s(j + 1) / s(j + 2);
    }
    std::swap(s, t);
  }
  return b;
}

/// Nodes and weights of the Gauss rule whose Jacobi matrix has b_1 .. b_(size-1) beside a zero
/// diagonal.
std::pair<ArrayXd, ArrayXd> golub_welsch(const VectorXd& b, Index size) {
  const VectorXd beside = b.segment(1, size - 1).cwiseSqrt();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(VectorXd::Zero(size), beside);
  ArrayXd node = solver.eigenvalues().array();
  node = 0.5 * (node - node.reverse().eval());  // symmetric to the last bit
  ArrayXd weight = b(0) * solver.eigenvectors().row(0).transpose().array().square();
  weight = 0.5 * (weight + weight.reverse().eval());
  return {node, weight};
}

KronrodRule make_rule(Index n) {
  VectorXd legendre(n);
  for (Index k = 0; k < n; ++k) {
    legendre(k) = legendre_b(k);
  }
  KronrodRule rule;
  std::tie(rule.node, rule.kronrod) = golub_welsch(jacobi_kronrod(n), 2 * n + 1);
  const ArrayXd gauss = n == 1 ? ArrayXd::Constant(1, 2.0) : golub_welsch(legendre, n).second;
  rule.gauss = ArrayXd::Zero(2 * n + 1);
  for (Index k = 0; k < n; ++k) {
    rule.gauss(2 * k + 1) = gauss(k);
  }
  return rule;
}

}  // namespace

const KronrodRule& kronrod_rule(int n) {
  if (n < 1) {
    throw std::domain_error("kronrod_rule: n must be >= 1");
  }
  static std::mutex mutex;
  static std::map<int, KronrodRule> rules;
  const std::scoped_lock lock(mutex);
  const auto found = rules.find(n);
  return found != rules.end() ? found->second : rules.emplace(n, make_rule(n)).first->second;
}

}  // namespace gonio

#include "emulator/uncertainty/input_set.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gonio {

std::size_t InputSet::add(InputQuantity input) {
  inputs_.push_back(std::move(input));
  return inputs_.size() - 1;
}

void InputSet::correlate(std::size_t a, std::size_t b, double coefficient) {
  if (a == b || !(std::abs(coefficient) <= 1.0)) {
    throw std::invalid_argument(fmt::format(
        "InputSet::correlate: expected two inputs and a coefficient in [-1, 1], found {}, {}, {}",
        a, b, coefficient));
  }
  for (const std::size_t i : {a, b}) {
    const Distribution& distribution = inputs_.at(i).distribution;
    if (distribution.shape != Distribution::Shape::normal ||
        std::isfinite(distribution.degrees_of_freedom)) {
      throw std::invalid_argument(
          fmt::format("InputSet::correlate: expected a normal distribution of {}", inputs_[i].id));
    }
  }
  pairs_.push_back({a, b, coefficient});
}

Eigen::MatrixXd InputSet::correlation() const {
  const auto n = Eigen::Index(size());
  Eigen::MatrixXd r = Eigen::MatrixXd::Identity(n, n);
  for (const Pair& pair : pairs_) {
    r(Eigen::Index(pair.a), Eigen::Index(pair.b)) = pair.coefficient;
    r(Eigen::Index(pair.b), Eigen::Index(pair.a)) = pair.coefficient;
  }
  return r;
}

double InputSet::smallest_eigenvalue() const {
  if (pairs_.empty()) {
    return 1.0;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation(), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

void InputSet::expect_positive_definite() const {
  if (const double smallest = smallest_eigenvalue(); !(smallest > positive_definite)) {
    throw std::domain_error(fmt::format(
        "expected a positive definite correlation matrix, found the eigenvalue {:.3g}", smallest));
  }
}

}  // namespace gonio

#include "emulator/uncertainty/propagation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gonio {

namespace {

/// Of the result, by Welch and Satterthwaite. What is correlated has degrees of freedom without end
/// (InputSet sees to that) and so adds nothing.
double effective_degrees_of_freedom(const std::vector<InputQuantity>& inputs,
                                    const Eigen::VectorXd& contribution, double u) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < contribution.size(); ++i) {
    sum +=
        std::pow(contribution(i) / u, 4) / inputs[std::size_t(i)].distribution.degrees_of_freedom;
  }
  return sum > 0.0 ? 1.0 / sum : std::numeric_limits<double>::infinity();
}

}  // namespace

Propagated propagate(const InputSet& inputs, const Eigen::VectorXd& sensitivity, double coverage) {
  const auto n = Eigen::Index(inputs.size());
  if (sensitivity.size() != n || !sensitivity.allFinite()) {
    throw std::invalid_argument(
        fmt::format("propagate: expected {} finite sensitivities, found {}{}", n,
                    sensitivity.size(), sensitivity.allFinite() ? "" : ", not all finite"));
  }
  inputs.expect_positive_definite();
  Eigen::VectorXd contribution(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    contribution(i) =
        sensitivity(i) * inputs.inputs()[std::size_t(i)].distribution.standard_uncertainty;
  }
  const Eigen::VectorXd with_others = inputs.correlation() * contribution;
  const double variance = contribution.dot(with_others);

  Propagated result;
  result.standard_uncertainty = std::sqrt(variance);
  result.degrees_of_freedom =
      variance > 0.0
          ? effective_degrees_of_freedom(inputs.inputs(), contribution, result.standard_uncertainty)
          : std::numeric_limits<double>::infinity();
  result.coverage_factor = coverage_factor(result.degrees_of_freedom, coverage);
  result.expanded_uncertainty = result.coverage_factor * result.standard_uncertainty;
  for (Eigen::Index i = 0; i < n; ++i) {
    result.budget.push_back(
        {.input = std::size_t(i),
         .sensitivity = sensitivity(i),
         .contribution = std::abs(contribution(i)),
         .share = variance > 0.0 ? contribution(i) * with_others(i) / variance : 0.0});
  }
  return result;
}

}  // namespace gonio

#include "emulator/procedure/prior_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using test::is_close;
using testing::SizeIs;

constexpr double last_bits = 1e-12;
/// Of what the search finds: it ends when the sum of squares no longer falls by 1e-6.
constexpr double found_share_of_u = 2e-3;

/// Of directions that are turned a little so that equal ones lie along the axes.
constexpr double of_axes = 1e-3;

VectorXd vector(const std::vector<double>& values) {
  return VectorXd::Map(values.data(), Eigen::Index(values.size()));
}

/// Observations of a linear model.
PriorFitProblem linear(const MatrixXd& derivatives, const std::vector<double>& observed,
                       const std::vector<double>& u_observed,
                       const std::vector<double>& u_assumed) {
  return {.model = [=](const VectorXd& x) -> VectorXd { return derivatives * x; },
          .jacobian = [=](const VectorXd&) { return derivatives; },
          .observed = vector(observed),
          .u_observed = vector(u_observed),
          .assumed = VectorXd::Zero(derivatives.cols()),
          .u_assumed = vector(u_assumed),
          .jacobian_assumed = derivatives};
}

TEST(PriorFit, WeighsAnObservationAgainstThePrior) {
  // x = 0 +- 1 and x = 10 +- 2: weights 4 and 1 in five.
  const PriorFit fit = fit_with_prior(linear(MatrixXd::Ones(1, 1), {10.0}, {2.0}, {1.0}));
  EXPECT_TRUE(fit.has_converged);
  EXPECT_TRUE(is_close(fit.estimate(0), 2.0, found_share_of_u));
  EXPECT_TRUE(is_close(fit.covariance(0, 0), 0.8, last_bits));
  EXPECT_TRUE(is_close(fit.residual(0), 8.0, found_share_of_u));
  EXPECT_TRUE(is_close(fit.chi_squared, 16.0 + 4.0, 1e-5));
}

TEST(PriorFit, OfALinearModelHasItsClosedForm) {
  const MatrixXd a{{1.0, 2.0, 0.0}, {0.5, -1.0, 3.0}, {2.0, 0.0, 1.0}, {0.0, 1.0, 1.0}};
  const PriorFitProblem problem =
      linear(a, {1.0, -2.0, 0.5, 3.0}, {0.1, 0.2, 0.3, 0.4}, {1.0, 2.0, 0.5});
  const PriorFit fit = fit_with_prior(problem);
  const MatrixXd weight =
      VectorXd(problem.u_observed.cwiseProduct(problem.u_observed).cwiseInverse()).asDiagonal();
  const MatrixXd prior_weight =
      VectorXd(problem.u_assumed.cwiseProduct(problem.u_assumed).cwiseInverse()).asDiagonal();
  const MatrixXd covariance = (a.transpose() * weight * a + prior_weight).inverse();
  const VectorXd estimate = covariance * a.transpose() * weight * problem.observed;
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_TRUE(
        is_close(fit.estimate(i), estimate(i), found_share_of_u * std::sqrt(covariance(i, i))));
    for (Eigen::Index j = 0; j < 3; ++j) {
      EXPECT_TRUE(is_close(fit.covariance(i, j), covariance(i, j), last_bits));
    }
  }
}

TEST(PriorFit, StaysWhereNothingIsObserved) {
  PriorFitProblem problem = linear(MatrixXd(0, 2), {}, {}, {0.5, 2.0});
  problem.assumed << 3.0, 4.0;
  const PriorFit fit = fit_with_prior(problem);
  EXPECT_TRUE(fit.has_converged);
  EXPECT_EQ(fit.estimate, problem.assumed);
  EXPECT_TRUE(is_close(fit.covariance(1, 1), 4.0, last_bits));
  EXPECT_EQ(fit.p_value, 1.0);
}

TEST(PriorFit, FindsAMinimumOfACurvedModel) {
  // exp(x) = e^2 known to 1e-3 of itself, from x = 0 +- 5: the prior weighs 1e-6 / 25.
  const double observed = std::exp(2.0);
  const PriorFit fit =
      fit_with_prior({.model = [](const VectorXd& x) -> VectorXd { return x.array().exp(); },
                      .jacobian = [](const VectorXd& x) -> MatrixXd { return x.array().exp(); },
                      .observed = vector({observed}),
                      .u_observed = vector({1e-3 * observed}),
                      .assumed = vector({0.0}),
                      .u_assumed = vector({5.0}),
                      .jacobian_assumed = MatrixXd::Ones(1, 1)});
  EXPECT_TRUE(fit.has_converged);
  EXPECT_TRUE(is_close(fit.estimate(0), 2.0, found_share_of_u * 1e-3));
  EXPECT_TRUE(is_close(std::sqrt(fit.covariance(0, 0)), 1e-3, 1e-6));
}

TEST(PriorFit, StepsBackFromWhereTheModelHasNoAnswer) {
  // The first step of the tangent, to x = 3.5, leads beyond the end of sqrt(4 - x^2) at 2.
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const PriorFit fit =
      fit_with_prior({.model = [](const VectorXd& x) -> VectorXd {
                        return vector({x(0) < 2.0 ? std::sqrt(4.0 - x(0) * x(0)) : nowhere});
                      },
                      .jacobian = [](const VectorXd& x) -> MatrixXd {
                        return vector({-x(0) / std::sqrt(4.0 - x(0) * x(0))});
                      },
                      .observed = vector({0.3}),
                      .u_observed = vector({1e-3}),
                      .assumed = vector({1.0}),
                      .u_assumed = vector({10.0}),
                      .jacobian_assumed = vector({-1.0 / std::sqrt(3.0)})});
  EXPECT_TRUE(fit.has_converged);
  EXPECT_TRUE(is_close(fit.estimate(0), std::sqrt(4.0 - 0.09), 1e-5));
}

TEST(PriorFit, TellsHowProbableItsResidualsAre) {
  // Two observations of nothing: chi squared of two degrees of freedom, exp(-x / 2).
  const PriorFit fit = fit_with_prior(linear(MatrixXd::Zero(2, 1), {1.0, 2.0}, {1.0, 1.0}, {1.0}));
  EXPECT_TRUE(is_close(fit.chi_squared, 5.0, last_bits));
  EXPECT_TRUE(is_close(fit.p_value, std::exp(-2.5), last_bits));
}

TEST(PriorFit, RefusesWhatIsNotAProblem) {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  EXPECT_EQ(test::message_of([&] { (void)fit_with_prior(linear(one, {1.0}, {0.0}, {1.0})); }),
            "fit_with_prior: uncertainties are > 0");
  EXPECT_EQ(test::message_of([&] { (void)fit_with_prior(linear(one, {1.0}, {1.0}, {-1.0})); }),
            "fit_with_prior: uncertainties are > 0");
  EXPECT_THROW((void)fit_with_prior(linear(one, {1.0}, {}, {1.0})), std::invalid_argument);
  EXPECT_THROW((void)fit_with_prior(linear(one, {1.0}, {1.0}, {})), std::invalid_argument);
  EXPECT_THROW((void)fit_with_prior(linear(MatrixXd(1, 0), {1.0}, {1.0}, {})),
               std::invalid_argument);
}

TEST(Confusions, AreOfParametersThatAreSeenTogetherOnly) {
  // x + y is observed to 0.01: x - y is as open as before.
  const PriorFit fit = fit_with_prior(linear(MatrixXd::Ones(1, 2), {0.0}, {0.01}, {1.0, 1.0}));
  const auto confusions = confusions_of(fit.covariance, VectorXd::Ones(2));
  ASSERT_THAT(confusions, SizeIs(1));
  EXPECT_TRUE(is_close(confusions[0].remaining, 1.0, of_axes));
  EXPECT_TRUE(is_close(confusions[0].direction[0], std::sqrt(0.5), of_axes));
  EXPECT_TRUE(is_close(confusions[0].direction[1], -std::sqrt(0.5), of_axes));
}

TEST(Confusions, AreToldInUnitsOfThePriors) {
  const Vector2d prior(0.1, 10.0);
  const PriorFit fit =
      fit_with_prior(linear(MatrixXd{{10.0, 0.1}}, {0.0}, {0.01}, {prior(0), prior(1)}));
  const auto confusions = confusions_of(fit.covariance, prior);
  ASSERT_THAT(confusions, SizeIs(1));
  EXPECT_TRUE(is_close(confusions[0].direction[0], std::sqrt(0.5), of_axes));
}

TEST(Confusions, AreNamedOneByOneWhereNothingIsSeen) {
  const auto confusions = confusions_of(MatrixXd::Identity(3, 3), VectorXd::Ones(3));
  ASSERT_THAT(confusions, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(is_close(confusions[i].direction[i], 1.0, last_bits));
    EXPECT_EQ(confusions[i].remaining, 1.0);
  }
}

TEST(Confusions, BeginWithTheLeastKnownAndEndAtHalfThePrior) {
  const VectorXd remaining = vector({0.4, 0.6, 0.49, 0.9});
  const auto confusions =
      confusions_of(remaining.cwiseProduct(remaining).asDiagonal(), VectorXd::Ones(4));
  ASSERT_THAT(confusions, SizeIs(2));
  EXPECT_TRUE(is_close(confusions[0].remaining, 0.9, last_bits));
  EXPECT_TRUE(is_close(confusions[1].remaining, 0.6, last_bits));
  EXPECT_TRUE(is_close(confusions[1].direction[1], 1.0, last_bits));
}

}  // namespace
}  // namespace gonio

#include "emulator/uncertainty/propagation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "emulator/uncertainty/random.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Shape = Distribution::Shape;
using test::is_close;
using test::message_of;
using testing::AllOf;
using testing::Ge;
using testing::Le;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;

/// Normal inputs of these standard uncertainties and degrees of freedom.
InputSet inputs_of(const std::vector<double>& u, const std::vector<double>& nu = {}) {
  InputSet inputs;
  for (std::size_t i = 0; i < u.size(); ++i) {
    inputs.add({.id = fmt::format("x{}", i),
                .distribution = {.standard_uncertainty = u[i],
                                 .degrees_of_freedom = nu.empty() ? infinite : nu[i]}});
  }
  return inputs;
}

double sum_of_shares(const Propagated& result) {
  double sum = 0.0;
  for (const Contribution& contribution : result.budget) {
    sum += contribution.share;
  }
  return sum;
}

// Examples of the guide.

TEST(LawOfPropagation, GivesTheGaugeBlockOfTheGuide) {
  // JCGM 100:2008, H.1: contributions in nm of the standard, the difference, the two expansion
  // coefficients and the temperature difference.
  const Propagated block = propagate(inputs_of({25.0, 9.7, 2.9, 16.6}, {18.0, 25.6, 50.0, 2.0}),
                                     Eigen::Vector4d::Ones(), 0.99);
  constexpr double last_digit = 0.5;
  EXPECT_TRUE(is_close(block.standard_uncertainty, 32.0, last_digit));
  EXPECT_EQ(std::floor(block.degrees_of_freedom), 16.0);
  EXPECT_TRUE(is_close(coverage_factor(16.0, 0.99), 2.92, 0.005));
  EXPECT_TRUE(is_close(block.coverage_factor, 2.92, 0.03));  // with 16.8 it is a little less
}

TEST(LawOfPropagation, GivesTheEffectiveDegreesOfFreedomOfTheGuide) {
  // JCGM 100:2008, G.4.1: relative uncertainties in per cent of the three factors of a product.
  const Propagated product =
      propagate(inputs_of({0.25, 0.57, 0.82}, {9.0, 4.0, 14.0}), Eigen::Vector3d::Ones());
  EXPECT_TRUE(is_close(product.standard_uncertainty, 1.03, 0.005));
  EXPECT_TRUE(is_close(product.degrees_of_freedom, 19.0, 0.05));
  EXPECT_TRUE(is_close(product.coverage_factor, 2.09, 0.005));
  EXPECT_TRUE(is_close(product.expanded_uncertainty, 2.2, 0.05));
}

TEST(LawOfPropagation, GivesResistanceAndReactanceOfTheGuide) {
  // JCGM 100:2008, H.2: voltage, current and phase measured together.
  const double v = 4.9990, i = 19.6610e-3, phi = 1.04446;
  InputSet inputs = inputs_of({0.0032, 0.0095e-3, 0.00075});
  inputs.correlate(0, 1, -0.36);
  inputs.correlate(0, 2, 0.86);
  inputs.correlate(1, 2, -0.65);
  const double z = v / i;
  const auto u_of = [&](double value, double by_phi) {
    return propagate(inputs, Eigen::Vector3d(value / v, -value / i, by_phi)).standard_uncertainty;
  };
  constexpr double rounding_of_coefficients = 0.0015;  // to two digits, where much cancels
  EXPECT_TRUE(
      is_close(u_of(z * std::cos(phi), -z * std::sin(phi)), 0.071, rounding_of_coefficients));
  EXPECT_TRUE(
      is_close(u_of(z * std::sin(phi), z * std::cos(phi)), 0.295, rounding_of_coefficients));
  EXPECT_TRUE(is_close(u_of(z, 0.0), 0.236, rounding_of_coefficients));
}

// Closed forms.

TEST(LawOfPropagation, AddsVariances) {
  const Propagated sum = propagate(inputs_of({3.0, 2.0}), Eigen::Vector2d(1.0, -2.0));
  EXPECT_TRUE(is_close(sum.standard_uncertainty, 5.0, rounding));
  EXPECT_EQ(sum.degrees_of_freedom, infinite);
  EXPECT_TRUE(is_close(sum.coverage_factor, 1.959963984540054, rounding));
  EXPECT_TRUE(is_close(sum.expanded_uncertainty, 5.0 * sum.coverage_factor, rounding));
  ASSERT_EQ(sum.budget.size(), 2U);
  EXPECT_EQ(sum.budget[1].input, 1U);
  EXPECT_EQ(sum.budget[1].sensitivity, -2.0);
  EXPECT_EQ(sum.budget[1].contribution, 4.0);
  EXPECT_TRUE(is_close(sum.budget[0].share, 9.0 / 25.0, rounding));
  EXPECT_TRUE(is_close(sum.budget[1].share, 16.0 / 25.0, rounding));
}

TEST(LawOfPropagation, OfACorrelatedSumEqualsTheClosedForm) {
  for (const double r : {-0.999, -0.5, 0.0, 0.7, 0.999}) {
    InputSet inputs = inputs_of({3.0, 4.0});
    inputs.correlate(0, 1, r);
    const Propagated sum = propagate(inputs, Eigen::Vector2d(1.0, 1.0));
    const double variance = 25.0 + 24.0 * r;
    EXPECT_TRUE(is_close(sum.standard_uncertainty, std::sqrt(variance), rounding));
    EXPECT_TRUE(is_close(sum.budget[0].share, (9.0 + 12.0 * r) / variance, rounding));
    EXPECT_TRUE(is_close(sum_of_shares(sum), 1.0, rounding));
  }
}

TEST(LawOfPropagation, OfWhatCancelsLeavesTheDifference) {
  InputSet inputs = inputs_of({0.1, 0.1});
  inputs.correlate(0, 1, 0.99);
  EXPECT_TRUE(is_close(propagate(inputs, Eigen::Vector2d(1.0, -1.0)).standard_uncertainty,
                       0.1 * std::sqrt(0.02), rounding));
}

TEST(LawOfPropagation, OfOneInputKeepsItsDegreesOfFreedom) {
  const Propagated one = propagate(inputs_of({0.5}, {3.5}), Eigen::VectorXd::Constant(1, 4.0));
  EXPECT_TRUE(is_close(one.degrees_of_freedom, 3.5, rounding));
  EXPECT_TRUE(is_close(one.coverage_factor, coverage_factor(3.5), rounding));
}

TEST(LawOfPropagation, TakesTheStandardUncertaintyOfAnyShape) {
  InputSet inputs;
  for (const Shape shape : {Shape::rectangular, Shape::triangular, Shape::arcsine}) {
    inputs.add({.id = "bounded", .distribution = Distribution::bounded(shape, 1.0)});
  }
  EXPECT_TRUE(is_close(propagate(inputs, Eigen::Vector3d::Ones()).standard_uncertainty,
                       std::sqrt(1.0 / 3.0 + 1.0 / 6.0 + 1.0 / 2.0), rounding));
}

TEST(LawOfPropagation, OfWhatIsKnownForSureIsZero) {
  for (const auto& sure :
       {propagate(inputs_of({0.0, 0.0}, {3.0, infinite}), Eigen::Vector2d(1.0, 1.0)),
        propagate(inputs_of({1.0, 2.0}), Eigen::Vector2d(0.0, 0.0))}) {
    EXPECT_EQ(sure.standard_uncertainty, 0.0);
    EXPECT_EQ(sure.expanded_uncertainty, 0.0);
    EXPECT_EQ(sure.degrees_of_freedom, infinite);
    EXPECT_TRUE(std::isfinite(sure.coverage_factor));
    EXPECT_EQ(sure.budget[0].share, 0.0);
    EXPECT_EQ(sure.budget[1].share, 0.0);
  }
}

// Coverage: of 10,000 measurements with a component of type A that has few degrees of freedom.

/// In how many of them the interval covers the truth.
/// @param u_b  normal, of type B; the type A component has the standard uncertainty 1.
template <int readings>
int covered(double u_b) {
  constexpr std::uint64_t seed = 41;
  constexpr int measurements = 10'000;
  const double sigma = std::sqrt(double(readings));  // of one reading
  int count = 0;
  for (int trial = 0; trial < measurements; ++trial) {
    std::vector<double> error(readings + 1);
    Draws(seed, std::uint64_t(trial)).normal(error);
    const Eigen::Map<const Eigen::Array<double, readings, 1>> noise(error.data());
    const double u_a = sigma * std::sqrt((noise - noise.mean()).square().sum() /
                                         double(readings * (readings - 1)));
    const Propagated found =
        propagate(inputs_of({u_a, u_b}, {double(readings - 1), infinite}), Eigen::Vector2d::Ones());
    const double off = sigma * noise.mean() + u_b * error[readings];
    count += std::abs(off) <= found.expanded_uncertainty ? 1 : 0;
  }
  return count;
}

TEST(ExpandedUncertainty, CoversTheTruthInNinetyFiveOfAHundredMeasurements) {
  EXPECT_THAT(covered<4>(0.0), AllOf(Ge(9400), Le(9600)));  // Student's own case: exact
  EXPECT_THAT(covered<4>(3.0), AllOf(Ge(9400), Le(9600)));
  for (const double u_b : {0.0, 0.5, 1.0, 3.0}) {
    EXPECT_THAT(covered<8>(u_b), AllOf(Ge(9400), Le(9600))) << u_b;
  }
}

TEST(ExpandedUncertainty, IsTooSmallWhereFewReadingsMeetAnotherComponentOfTheirSize) {
  // Welch and Satterthwaite put the estimate in place of the true variance. It costs little.
  EXPECT_THAT(covered<4>(0.5), AllOf(Ge(9250), Le(9400)));
}

// Errors of the caller.

TEST(LawOfPropagation, RefusesSensitivitiesThatDoNotFit) {
  const InputSet two = inputs_of({1.0, 1.0});
  EXPECT_THROW((void)propagate(two, Eigen::Vector3d::Ones()), std::invalid_argument);
  EXPECT_EQ(message_of([&] { (void)propagate(two, Eigen::Vector3d::Ones()); }),
            "propagate: expected 2 finite sensitivities, found 3");
  EXPECT_EQ(message_of([&] { (void)propagate(two, Eigen::Vector2d(1.0, infinite)); }),
            "propagate: expected 2 finite sensitivities, found 2, not all finite");
}

TEST(LawOfPropagation, RefusesCorrelationsThatMakeAVarianceNegative) {
  InputSet inputs = inputs_of({1.0, 1.0, 1.0});
  inputs.correlate(0, 1, -0.9);
  inputs.correlate(0, 2, -0.9);
  inputs.correlate(1, 2, -0.9);
  EXPECT_EQ(message_of([&] { (void)propagate(inputs, Eigen::Vector3d::Ones()); }),
            "expected a positive definite correlation matrix, found the eigenvalue -0.8");
}

TEST(LawOfPropagation, RefusesACoverageThatIsNone) {
  EXPECT_THROW((void)propagate(inputs_of({1.0}), Eigen::VectorXd::Ones(1), 1.0), std::domain_error);
}

}  // namespace
}  // namespace gonio

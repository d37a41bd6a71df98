#include "emulator/uncertainty/monte_carlo.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/uncertainty/propagation.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Shape = Distribution::Shape;
using test::is_close;
using test::is_close_relative;
using test::message_of;

constexpr std::uint64_t seed = 101;
constexpr std::size_t million = 1'000'000;

void add_all(const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) { y.col(0) = x.rowwise().sum(); }

MonteCarloOutput of_sum(const InputSet& inputs) {
  return monte_carlo(inputs, 1, add_all, {.seed = seed, .trials = million}).outputs.front();
}

/// Inputs of one shape and these standard uncertainties.
InputSet inputs_of(Shape shape, const std::vector<double>& u) {
  InputSet inputs;
  for (const double one : u) {
    inputs.add({.id = "x", .distribution = {.shape = shape, .standard_uncertainty = one}});
  }
  return inputs;
}

double expanded_by_law(const InputSet& inputs) {
  return propagate(inputs, Eigen::VectorXd::Ones(Eigen::Index(inputs.size()))).expanded_uncertainty;
}

// JCGM 101:2008, 9.2: additive models. The ends of the interval of a million trials have a standard
// deviation of about 0.003 u.

constexpr double two_digits = 0.02;

TEST(MonteCarlo, OfFourNormalInputsAgreesWithTheLawOfPropagation) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0, 1.0, 1.0, 1.0});
  const MonteCarloOutput sum = of_sum(inputs);
  EXPECT_TRUE(is_close(sum.mean, 0.0, 0.01));
  EXPECT_TRUE(is_close(sum.standard_uncertainty, 2.0, 0.01));
  EXPECT_TRUE(is_close(sum.low, -3.92, two_digits));
  EXPECT_TRUE(is_close(sum.high, 3.92, two_digits));
  EXPECT_TRUE(is_close(expanded_by_law(inputs), 3.92, 0.005));
}

TEST(MonteCarlo, OfFourRectangularInputsIsNarrowerThanTheLawOfPropagation) {
  const InputSet inputs = inputs_of(Shape::rectangular, {1.0, 1.0, 1.0, 1.0});
  const double end = 2.0 * std::sqrt(3.0) * (2.0 - std::pow(0.6, 0.25));  // 3.88
  const MonteCarloOutput sum = of_sum(inputs);
  EXPECT_TRUE(is_close(sum.standard_uncertainty, 2.0, 0.01));
  EXPECT_TRUE(is_close(sum.low, -end, two_digits));
  EXPECT_TRUE(is_close(sum.high, end, two_digits));
  EXPECT_TRUE(is_close(expanded_by_law(inputs), 3.92, 0.005));
}

TEST(MonteCarlo, OfOneRectangularInputThatRulesIsFarNarrower) {
  const InputSet inputs = inputs_of(Shape::rectangular, {1.0, 1.0, 1.0, 10.0});
  const MonteCarloOutput sum = of_sum(inputs);
  EXPECT_TRUE(is_close(sum.standard_uncertainty, std::sqrt(103.0), 0.05));
  EXPECT_TRUE(is_close(sum.low, -17.0, 0.05));
  EXPECT_TRUE(is_close(sum.high, 17.0, 0.05));
  EXPECT_TRUE(is_close(expanded_by_law(inputs), 19.9, 0.05));
}

TEST(MonteCarlo, GivesTheMassCalibrationOfTheSupplement) {
  // JCGM 101:2008, 9.3: buoyancy at air densities about that of the convention. Masses in mg above
  // 100 g, densities in kg/m^3.
  InputSet inputs;
  inputs.add({.id = "m_r", .distribution = {.standard_uncertainty = 0.050}});
  inputs.add({.id = "d_m", .estimate = 1.234, .distribution = {.standard_uncertainty = 0.020}});
  const auto box = [&](const char* id, double centre, double half_width) {
    inputs.add({.id = id,
                .estimate = centre,
                .distribution = Distribution::bounded(Shape::rectangular, half_width)});
  };
  box("rho_air", 1.20, 0.10);
  box("rho_weight", 8000.0, 1000.0);
  box("rho_reference", 8000.0, 50.0);
  const BatchModel model = [](const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) {
    const Eigen::ArrayXd above = x.col(0) + x.col(1);
    y.col(0) = above + (1e5 + above) * (x.col(2) - 1.2) * (1.0 / x.col(3) - 1.0 / x.col(4));
  };
  const MonteCarloOutput mass =
      monte_carlo(inputs, 1, model, {.seed = seed, .trials = million}).outputs.front();
  constexpr double last_digits = 0.0006;
  EXPECT_TRUE(is_close(mass.mean, 1.2341, last_digits));
  EXPECT_TRUE(is_close(mass.standard_uncertainty, 0.0754, last_digits));
  // The supplement gives the shortest interval, [1.0834, 1.3825].
  EXPECT_TRUE(is_close(mass.expanded_uncertainty(), 0.1496, last_digits));
  // By the law of propagation no density counts: [1.1285, 1.3395].
  Eigen::VectorXd sensitivity = Eigen::VectorXd::Zero(5);
  sensitivity.head(2).setOnes();
  const Propagated by_law = propagate(inputs, sensitivity);
  EXPECT_TRUE(is_close(by_law.standard_uncertainty, 0.0539, 0.00005));
  EXPECT_TRUE(is_close(by_law.expanded_uncertainty, 0.1055, 0.00005));
}

TEST(MonteCarlo, OfASumOfSquaresAboutZeroIsExponential) {
  // JCGM 101:2008, 9.4, at zero: the law of propagation finds no uncertainty at all.
  const double u = 0.005;
  const InputSet inputs = inputs_of(Shape::normal, {u, u});
  const BatchModel model = [](const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) {
    y.col(0) = x.square().rowwise().sum();
  };
  const MonteCarloOutput loss =
      monte_carlo(inputs, 1, model, {.seed = seed, .trials = million}).outputs.front();
  const double mean = 2.0 * u * u;
  constexpr double relative = 0.01;
  EXPECT_TRUE(is_close_relative(loss.mean, mean, relative));
  EXPECT_TRUE(is_close_relative(loss.standard_uncertainty, mean, relative));
  EXPECT_TRUE(is_close_relative(loss.low, -mean * std::log(0.975), 2.0 * relative));
  EXPECT_TRUE(is_close_relative(loss.high, -mean * std::log(0.025), relative));
}

TEST(MonteCarlo, OfStudentsInputHasItsQuantiles) {
  InputSet inputs;
  inputs.add({.id = "few",
              .estimate = 7.0,
              .distribution = {.standard_uncertainty = 0.3, .degrees_of_freedom = 5.0}});
  const MonteCarloOutput few = of_sum(inputs);
  EXPECT_TRUE(is_close(few.high, 7.0 + 0.3 * coverage_factor(5.0), 0.01));
  EXPECT_TRUE(is_close(few.expanded_uncertainty(), 0.3 * coverage_factor(5.0), 0.01));
  EXPECT_TRUE(is_close(few.standard_uncertainty, 0.3 * std::sqrt(5.0 / 3.0), 0.01));
}

TEST(MonteCarlo, OfACorrelatedSumEqualsTheClosedForm) {
  for (const double r : {-0.9, 0.5}) {
    InputSet inputs = inputs_of(Shape::normal, {3.0, 4.0});
    inputs.correlate(0, 1, r);
    const double u = std::sqrt(25.0 + 24.0 * r);
    EXPECT_TRUE(is_close_relative(of_sum(inputs).standard_uncertainty, u, 0.005));
    EXPECT_TRUE(is_close_relative(of_sum(inputs).expanded_uncertainty(), 1.96 * u, 0.005));
  }
}

TEST(MonteCarlo, CoversAsMuchAsItIsAsked) {
  const InputSet inputs = inputs_of(Shape::rectangular, {1.0});
  for (const double coverage : {0.5, 0.9, 0.99}) {
    const MonteCarloResult result =
        monte_carlo(inputs, 1, add_all, {.seed = seed, .coverage = coverage, .trials = million});
    EXPECT_TRUE(
        is_close(result.outputs[0].expanded_uncertainty(), coverage * std::sqrt(3.0), 0.005));
  }
}

TEST(MonteCarlo, OfWhatIsKnownForSureHasNoUncertainty) {
  InputSet inputs;
  inputs.add({.id = "x", .estimate = 0.1});
  inputs.add({.id = "y", .estimate = 0.2});
  const MonteCarloResult result = monte_carlo(inputs, 1, add_all, {});
  const MonteCarloOutput& sum = result.outputs.front();
  EXPECT_EQ(sum.mean, 0.1 + 0.2);
  EXPECT_EQ(sum.standard_uncertainty, 0.0);
  EXPECT_EQ(sum.expanded_uncertainty(), 0.0);
  EXPECT_EQ(sum.instability, 0.0);
  EXPECT_TRUE(result.is_stable);
}

// When it stops.

TEST(MonteCarlo, StopsWhenTwoDigitsAreStable) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0, 1.0});
  const MonteCarloResult result = monte_carlo(inputs, 1, add_all, {.seed = seed});
  EXPECT_TRUE(result.is_stable);
  EXPECT_LT(result.trials, million);
  EXPECT_LE(result.outputs[0].instability, 1.0);
  // Half a unit of the second digit of u = 1.4, for all four.
  EXPECT_TRUE(is_close(result.outputs[0].mean, 0.0, 0.05));
  EXPECT_TRUE(is_close(result.outputs[0].standard_uncertainty, std::sqrt(2.0), 0.05));
  EXPECT_TRUE(is_close(result.outputs[0].high, 1.96 * std::sqrt(2.0), 0.05));
}

TEST(MonteCarlo, GivesUpWhereItIsNeverStable) {
  InputSet cauchy;
  cauchy.add(
      {.id = "wild", .distribution = {.standard_uncertainty = 1.0, .degrees_of_freedom = 1.0}});
  const MonteCarloResult result =
      monte_carlo(cauchy, 1, add_all, {.seed = seed, .most_trials = 250'000});
  EXPECT_FALSE(result.is_stable);
  EXPECT_EQ(result.trials, 250'000U);
  EXPECT_GT(result.outputs[0].instability, 1.0);
}

TEST(MonteCarlo, OfOneBlockIsNotCalledStable) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0});
  EXPECT_FALSE(monte_carlo(inputs, 1, add_all, {.seed = seed, .trials = 1}).is_stable);
}

TEST(MonteCarlo, RoundsTrialsUpToWholeBlocksAndTellsOfEach) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0});
  std::vector<std::size_t> told;
  const MonteCarloResult result = monte_carlo(
      inputs, 1, add_all,
      {.seed = seed, .trials = 95'000, .advance = [&](std::size_t done) { told.push_back(done); }});
  EXPECT_EQ(result.trials, 100'000U);
  ASSERT_EQ(told.size(), 10U);
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i], 10'000 * (i + 1));
  }
}

TEST(MonteCarlo, StopsWhereTheCallerInterruptsIt) {
  struct Interrupted {};
  const InputSet inputs = inputs_of(Shape::normal, {1.0});
  std::size_t told = 0;
  EXPECT_THROW((void)monte_carlo(inputs, 1, add_all,
                                 {.seed = seed,
                                  .trials = million,
                                  .advance =
                                      [&](std::size_t) {
                                        ++told;
                                        throw Interrupted();
                                      }}),
               Interrupted);
  EXPECT_LT(told, 100U);
}

// The same for any number of threads.

TEST(MonteCarlo, GivesTheSameBitsOnAnyNumberOfThreads) {
  InputSet inputs = inputs_of(Shape::normal, {1.0, 2.0});
  inputs.add({.id = "box", .distribution = Distribution::bounded(Shape::rectangular, 3.0)});
  inputs.add({.id = "few", .distribution = {.standard_uncertainty = 1.0, .degrees_of_freedom = 6}});
  inputs.correlate(0, 1, 0.5);
  const BatchModel two_outputs = [](const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) {
    y.col(0) = x.rowwise().sum();
    y.col(1) = x.col(0) * x.col(2);
  };
  const auto on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return monte_carlo(inputs, 2, two_outputs, {.seed = seed});
  };
  const MonteCarloResult one = on(1);
  for (const std::size_t threads : {2U, 4U}) {
    const MonteCarloResult other = on(threads);
    EXPECT_EQ(other.trials, one.trials);
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_EQ(other.outputs[j].mean, one.outputs[j].mean);
      EXPECT_EQ(other.outputs[j].standard_uncertainty, one.outputs[j].standard_uncertainty);
      EXPECT_EQ(other.outputs[j].low, one.outputs[j].low);
      EXPECT_EQ(other.outputs[j].high, one.outputs[j].high);
      EXPECT_EQ(other.outputs[j].instability, one.outputs[j].instability);
    }
  }
}

TEST(MonteCarlo, DependsOnItsSeed) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0});
  const auto mean_of = [&](std::uint64_t of_seed) {
    return monte_carlo(inputs, 1, add_all, {.seed = of_seed, .trials = 1}).outputs[0].mean;
  };
  EXPECT_EQ(mean_of(1), mean_of(1));
  EXPECT_NE(mean_of(1), mean_of(2));
}

// Errors.

TEST(MonteCarlo, RefusesWhatIsNotFinite) {
  const InputSet inputs = inputs_of(Shape::normal, {1.0});
  const BatchModel root = [](const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) {
    y.col(0) = x.col(0).sqrt();
  };
  EXPECT_EQ(message_of([&] { (void)monte_carlo(inputs, 1, root, {}); }),
            "monte_carlo: expected 1 finite outputs of 10000 trials from the model");
  EXPECT_THROW((void)monte_carlo(inputs, 1, root, {}), std::domain_error);
}

TEST(MonteCarlo, RefusesCorrelationsAndCoveragesThatAreNone) {
  InputSet inputs = inputs_of(Shape::normal, {1.0, 1.0});
  EXPECT_EQ(message_of([&] { (void)monte_carlo(inputs, 1, add_all, {.coverage = 1.0}); }),
            "monte_carlo: expected a coverage in (0, 1), found 1");
  inputs.correlate(0, 1, -1.0);
  EXPECT_THROW((void)monte_carlo(inputs, 1, add_all, {}), std::domain_error);
}

}  // namespace
}  // namespace gonio

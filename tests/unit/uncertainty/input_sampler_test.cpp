#include "emulator/uncertainty/input_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using Shape = Distribution::Shape;
using test::is_close;

constexpr std::uint64_t seed = 101;
constexpr Eigen::Index count = 200'000;
constexpr double five_sigma = 5.0;  // a right sampler fails once in two million

/// One of each shape; Student's with degrees of freedom that are not whole.
InputSet one_of_each() {
  InputSet inputs;
  inputs.add({.id = "normal", .estimate = 3.0, .distribution = {.standard_uncertainty = 0.5}});
  inputs.add({.id = "box",
              .estimate = -1.0,
              .distribution = Distribution::bounded(Shape::rectangular, 2.0)});
  inputs.add({.id = "few",
              .estimate = 10.0,
              .distribution = {.standard_uncertainty = 0.1, .degrees_of_freedom = 4.5}});
  inputs.add({.id = "tent", .distribution = Distribution::bounded(Shape::triangular, 2.0)});
  inputs.add({.id = "sine", .distribution = Distribution::bounded(Shape::arcsine, 2.0)});
  inputs.add({.id = "sure", .estimate = 1.567});
  inputs.add(
      {.id = "fewer",
       .distribution = {
           .shape = Shape::student, .standard_uncertainty = 2.0, .degrees_of_freedom = 1.0}});
  return inputs;
}

Eigen::ArrayXXd drawn(const InputSet& inputs, Eigen::Index n = count, std::uint64_t first = 0) {
  Eigen::ArrayXXd x(n, Eigen::Index(inputs.size()));
  InputSampler(inputs, seed).draw(first, x);
  return x;
}

TEST(InputSampler, DrawsAsOftenBelowAQuantileAsItsShareSays) {
  const InputSet inputs = one_of_each();
  const Eigen::ArrayXXd x = drawn(inputs);
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const InputQuantity& input = inputs.inputs()[j];
    if (input.distribution.standard_uncertainty == 0.0) {
      continue;
    }
    for (const double p : {0.001, 0.025, 0.2, 0.5, 0.8, 0.975, 0.999}) {
      const double bound = input.estimate + quantile(input.distribution, p);
      const double share = double((x.col(Eigen::Index(j)) < bound).count()) / double(count);
      EXPECT_TRUE(is_close(share, p, five_sigma * std::sqrt(p * (1.0 - p) / double(count))))
          << input.id << ' ' << p;
    }
  }
}

TEST(InputSampler, DrawsTheMomentsOfEachShape) {
  const InputSet inputs = one_of_each();
  const Eigen::ArrayXXd x = drawn(inputs);
  for (const Eigen::Index j : {0, 1, 3, 4}) {
    const InputQuantity& input = inputs.inputs()[std::size_t(j)];
    const double u = input.distribution.standard_uncertainty;
    const double sigma = u / std::sqrt(double(count));
    EXPECT_TRUE(is_close(x.col(j).mean(), input.estimate, five_sigma * sigma)) << input.id;
    // The normal distribution has the largest fourth moment of these.
    const double variance = (x.col(j) - input.estimate).square().mean();
    EXPECT_TRUE(is_close(variance, u * u, five_sigma * u * sigma * std::sqrt(2.0))) << input.id;
  }
}

TEST(InputSampler, StaysWithinBounds) {
  const Eigen::ArrayXXd x = drawn(one_of_each());
  EXPECT_LE((x.col(1) + 1.0).abs().maxCoeff(), 2.0);
  EXPECT_LE(x.col(3).abs().maxCoeff(), 2.0);
  EXPECT_LE(x.col(4).abs().maxCoeff(), 2.0);
}

TEST(InputSampler, DrawsTheEstimateOfWhatIsKnownForSure) {
  EXPECT_TRUE((drawn(one_of_each(), 1000).col(5) == 1.567).all());
}

TEST(InputSampler, DrawsATrialAlikeWhicheverBlockItIsIn) {
  InputSet inputs = one_of_each();
  inputs.add({.id = "mate", .distribution = {.standard_uncertainty = 1.0}});
  inputs.correlate(0, 7, 0.5);
  const Eigen::ArrayXXd all = drawn(inputs, 1200, 0);
  constexpr double rounding = 1e-14;  // of the last elements of a block, which no SIMD takes
  for (const std::uint64_t first : {1U, 100U, 1150U}) {
    const Eigen::ArrayXXd some = drawn(inputs, 50, first);
    EXPECT_LT((some - all.middleRows(Eigen::Index(first), 50)).abs().maxCoeff(), rounding);
  }
}

TEST(InputSampler, DrawsAnInputAlikeWhateverFollowsIt) {
  InputSet inputs = one_of_each();
  const Eigen::ArrayXXd before = drawn(inputs, 500);
  inputs.add({.id = "more", .distribution = {.standard_uncertainty = 1.0}});
  EXPECT_TRUE((drawn(inputs, 500).leftCols(before.cols()) == before).all());
}

// Correlation.

TEST(InputSampler, DrawsTheCorrelationThatIsStated) {
  InputSet inputs = one_of_each();
  for (const char* id : {"a", "b", "c"}) {
    inputs.add({.id = id, .distribution = {.standard_uncertainty = 3.0}});
  }
  // All of 0, 7, 8, 9 hang together; 8 and 9 only over the others.
  inputs.correlate(0, 7, 0.6);
  inputs.correlate(7, 8, -0.5);
  inputs.correlate(0, 9, 0.3);
  const Eigen::MatrixXd expected = inputs.correlation();
  const Eigen::ArrayXXd x = drawn(inputs);
  for (const Eigen::Index a : {0, 1, 3, 7, 8, 9}) {
    for (const Eigen::Index b : {0, 1, 3, 7, 8, 9}) {
      const auto centred = [&](Eigen::Index j) {
        const InputQuantity& input = inputs.inputs()[std::size_t(j)];
        return (x.col(j) - input.estimate) / input.distribution.standard_uncertainty;
      };
      const double sigma = std::sqrt(2.0 / double(count));  // the most that it can be
      EXPECT_TRUE(is_close((centred(a) * centred(b)).mean(), expected(a, b), five_sigma * sigma))
          << a << ' ' << b;
    }
  }
}

TEST(InputSampler, LeavesWhatIsNotCorrelatedAsItWas) {
  InputSet inputs = one_of_each();
  inputs.add({.id = "mate", .distribution = {.standard_uncertainty = 1.0}});
  const Eigen::ArrayXXd before = drawn(inputs, 500);
  inputs.correlate(0, 7, 0.5);
  const Eigen::ArrayXXd after = drawn(inputs, 500);
  EXPECT_TRUE((after.leftCols(7) == before.leftCols(7)).all());
  EXPECT_FALSE((after.col(7) == before.col(7)).any());
}

TEST(InputSampler, RefusesCorrelationsThatContradictEachOther) {
  InputSet inputs;
  for (const char* id : {"a", "b"}) {
    inputs.add({.id = id, .distribution = {.standard_uncertainty = 1.0}});
  }
  inputs.correlate(0, 1, 1.0);
  EXPECT_THROW(InputSampler(inputs, seed), std::domain_error);
}

}  // namespace
}  // namespace gonio

#include "emulator/statistics/sampling_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "emulator/statistics/normal.hpp"
#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;

double binomial_sum(std::size_t n, std::size_t c, double p) {
  double term = std::pow(1.0 - p, double(n)), sum = term;
  for (std::size_t k = 0; k < c; ++k) {
    term *= double(n - k) / double(k + 1) * p / (1.0 - p);
    sum += term;
  }
  return sum;
}

TEST(AcceptedByAttributes, EqualsTheBinomialSum) {
  for (const auto& [n, c] : std::vector<std::pair<std::size_t, std::size_t>>{
           {1, 0}, {5, 1}, {20, 3}, {89, 2}, {315, 14}}) {
    for (const double p : {0.0, 0.001, 0.01, 0.1, 0.3, 0.7}) {
      EXPECT_TRUE(is_close(accepted_by_attributes(n, c, p), binomial_sum(n, c, p), rounding))
          << n << " " << c << " " << p;
    }
  }
}

// Montgomery, Introduction to Statistical Quality Control, chapter on lot-by-lot acceptance
// sampling: n = 89, c = 2.
TEST(AcceptedByAttributes, EqualsTheTableOfMontgomery) {
  constexpr double printed = 0.00005;
  for (const auto& [p, accepted] : std::vector<std::pair<double, double>>{{0.005, 0.9897},
                                                                          {0.010, 0.9397},
                                                                          {0.020, 0.7366},
                                                                          {0.030, 0.4985},
                                                                          {0.040, 0.3042},
                                                                          {0.050, 0.1721},
                                                                          {0.060, 0.0919},
                                                                          {0.070, 0.0468},
                                                                          {0.080, 0.0230},
                                                                          {0.090, 0.0109}}) {
    EXPECT_TRUE(is_close(accepted_by_attributes(89, 2, p), accepted, printed)) << p;
  }
}

TEST(AcceptedByAttributes, AcceptsAllThatCannotFail) {
  EXPECT_EQ(accepted_by_attributes(5, 5, 1.0), 1.0);
  EXPECT_EQ(accepted_by_attributes(5, 9, 0.5), 1.0);
  EXPECT_EQ(accepted_by_attributes(0, 0, 1.0), 1.0);
  EXPECT_EQ(accepted_by_attributes(5, 0, 0.0), 1.0);
  EXPECT_EQ(accepted_by_attributes(5, 4, 1.0), 0.0);
  EXPECT_EQ(test::message_of([] { (void)accepted_by_attributes(5, 1, 1.5); }),
            "accepted_by_attributes: expected p in [0, 1], found 1.5");
}

// With k = 0 the mean alone decides.
TEST(AcceptedByVariables, OfKZeroIsTheChanceOfTheMean) {
  for (const std::size_t n : {2u, 10u, 300u}) {
    for (const double margin : {-1.0, 0.0, 0.1, 2.0}) {
      EXPECT_TRUE(is_close(*accepted_by_variables(n, 0.0, 5.0 - margin, 1.5, {.high = 5.0}),
                           normal_below(std::sqrt(double(n)) * margin / 1.5), rounding));
    }
  }
}

// With the mean at the limit t is central: of one degree of freedom, Cauchy's; of two,
// P(T <= t) = 1/2 + t / (2 sqrt(2 + t^2)).
TEST(AcceptedByVariables, WithTheMeanAtTheLimitIsCentral) {
  for (const double k : {-1.0, 0.4, 2.0}) {
    const double t_2 = k * std::sqrt(2.0), t_3 = k * std::sqrt(3.0);
    EXPECT_TRUE(is_close(*accepted_by_variables(2, k, 5.0, 1.5, {.low = 5.0}),
                         0.5 - std::atan(t_2) / pi, rounding));
    EXPECT_TRUE(is_close(*accepted_by_variables(3, k, 5.0, 1.5, {.high = 5.0}),
                         0.5 - t_3 / (2.0 * std::sqrt(2.0 + t_3 * t_3)), rounding));
  }
}

// Given s, the mean is independent of it and normal: the integral of that over the density of s.
double accepted_by_quadrature(std::size_t n, double k, double margin) {
  const double freedom = double(n - 1), root_n = std::sqrt(double(n));
  const double width = 10.0 / std::sqrt(2.0 * freedom), high = 1.0 + width;
  const double low = std::max(0.0, 1.0 - width);
  const int steps = 20000;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double s = low + (high - low) * (i + 0.5) / steps;
    const double density = std::exp((freedom - 1.0) * std::log(s) - freedom / 2.0 * (s * s - 1.0));
    sum += density * normal_below(root_n * (margin - k * s));
    weights += density;
  }
  return sum / weights;
}

TEST(AcceptedByVariables, EqualsTheIntegralOverTheStandardDeviation) {
  constexpr double midpoints = 1e-7;
  for (const std::size_t n : {4u, 15u, 50u, 400u, 5000u}) {
    for (const double k : {0.5, 1.81, 2.5}) {
      for (const double margin : {-0.5, 0.4, 1.0, 1.81, 2.2, 3.0, 9.0}) {
        EXPECT_TRUE(is_close(*accepted_by_variables(n, k, -margin, 1.0, {.high = 0.0}),
                             accepted_by_quadrature(n, k, margin), midpoints))
            << n << " " << k << " " << margin;
      }
    }
  }
}

// Seed 43; 100000 lots each.
TEST(AcceptedByVariables, IsWhatAPlanDoesThatIsPlayed) {
  const std::size_t lots = test::trials(100000), n = 10;
  constexpr double k = 1.5;
  std::mt19937_64 random(43);
  for (const double mean : {80.0, 82.0, 83.0}) {
    std::normal_distribution<double> values(mean, 2.0);
    std::size_t accepted = 0;
    for (std::size_t lot = 0; lot < lots; ++lot) {
      RunningStatistics sample;
      for (std::size_t i = 0; i < n; ++i) {
        sample.add(values(random));
      }
      accepted += sample.result().mean - 78.0 >= k * sample.result().standard_deviation;
    }
    const double expected = *accepted_by_variables(n, k, mean, 2.0, {.low = 78.0});
    EXPECT_TRUE(is_close(double(accepted) / double(lots), expected,
                         4.0 * std::sqrt(expected * (1.0 - expected) / double(lots))))
        << mean;
  }
}

// Of many values the mean less k s is normal, with sqrt((1 + k^2 / 2) / n) sigma; it is told apart
// from that by a share of the skewness of s, which goes with 1 / sqrt(n).
TEST(AcceptedByVariables, OfManyValuesIsNormal) {
  const std::size_t n = 100000;
  const double k = 2.0, spread = std::sqrt((1.0 + k * k / 2.0) / double(n));
  const double skewness = 1.0 / std::sqrt(double(n));
  for (const double z : {-2.0, 0.0, 1.0}) {
    EXPECT_TRUE(is_close(*accepted_by_variables(n, k, 0.0, 1.0, {.high = k + z * spread}),
                         normal_below(z), skewness));
  }
}

TEST(AcceptedByVariables, IsOneOrNothingFarFromTheLimit) {
  for (const std::size_t n : {2u, 6u, 100u, 10000u}) {
    for (const double far : {1e2, 1e4, 1e8, 1e300}) {
      EXPECT_TRUE(
          is_close(*accepted_by_variables(n, 1.0, 0.0, 1.0, {.high = far}), 1.0, 2e-2 / far))
          << n << " " << far;
      EXPECT_TRUE(is_close(*accepted_by_variables(n, 1.0, 0.0, 1.0, {.low = far}), 0.0, rounding))
          << n << " " << far;
    }
  }
  EXPECT_EQ(accepted_by_variables(5, 1.0, 3.0, 0.0, {.high = 3.0}), 1.0);
  EXPECT_EQ(accepted_by_variables(5, 1.0, 3.1, 0.0, {.high = 3.0}), 0.0);
}

TEST(AcceptedByVariables, MirrorsItsLimits) {
  EXPECT_TRUE(is_close_relative(*accepted_by_variables(8, 1.2, 3.0, 1.0, {.high = 5.0}),
                                *accepted_by_variables(8, 1.2, -3.0, 1.0, {.low = -5.0}),
                                rounding));
}

TEST(AcceptedByVariables, HasNoClosedFormForTwoLimits) {
  EXPECT_FALSE(accepted_by_variables(8, 1.2, 3.0, 1.0, {.low = 0.0, .high = 5.0}));
  EXPECT_EQ(accepted_by_variables(8, 1.2, 3.0, 1.0, {}), 1.0);
  EXPECT_THROW((void)accepted_by_variables(1, 1.2, 3.0, 1.0, {.high = 5.0}), std::domain_error);
  EXPECT_THROW((void)accepted_by_variables(8, 1.2, 3.0, -1.0, {.high = 5.0}), std::domain_error);
}

}  // namespace
}  // namespace gonio

#include "emulator/statistics/capability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "emulator/statistics/normal.hpp"
#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-12;
constexpr double two_decimals = 0.005;     // as printed
constexpr double four_decimals = 0.00005;  // as printed

// NIST/SEMATECH e-Handbook of Statistical Methods, 6.1.6: limits 8 and 20, mean 16, s 2.
TEST(Capability, EqualsTheExampleOfNist) {
  const EstimatedSpread spread{.value = 2.0, .degrees_of_freedom = 99.0};
  const Capability got = capability(16.0, 100, spread, spread, {.low = 8.0, .high = 20.0});
  EXPECT_TRUE(is_close(got.cp.value().value, 1.0, four_decimals));
  EXPECT_TRUE(is_close(got.cpk.value().value, 0.6667, four_decimals));
  EXPECT_EQ(got.pp, got.cp);
  EXPECT_EQ(got.ppk, got.cpk);
}

// Montgomery, Introduction to Statistical Quality Control, chapter on process capability: limits 38
// and 62, centred, n = 20, s = 1.75; the book goes on with C_p = 2.29, rounded.
TEST(Capability, HasTheIntervalOfCpOfMontgomery) {
  const EstimatedSpread spread{.value = 24.0 / (6.0 * 2.29), .degrees_of_freedom = 19.0};
  const Estimate got = capability(50.0, 20, spread, spread, {.low = 38.0, .high = 62.0}).cp.value();
  EXPECT_TRUE(is_close(got.low, 1.57, two_decimals));
  EXPECT_TRUE(is_close(got.high, 3.01, two_decimals));
}

// The same chapter: n = 20, C_pk = 1.33.
TEST(Capability, HasTheIntervalOfCpkOfMontgomery) {
  const EstimatedSpread spread{.value = 1.0, .degrees_of_freedom = 19.0};
  const Estimate got = capability(0.0, 20, spread, spread, {.high = 3.99}).cpk.value();
  EXPECT_TRUE(is_close(got.value, 1.33, two_decimals));
  EXPECT_TRUE(is_close(got.low, 0.88, two_decimals));
  EXPECT_TRUE(is_close(got.high, 1.78, two_decimals));
}

// Chi squared of two degrees of freedom is exponential.
TEST(Capability, HasAnIntervalInClosedFormForTwoDegreesOfFreedom) {
  const EstimatedSpread spread{.value = 0.5, .degrees_of_freedom = 2.0};
  const Estimate got =
      capability(0.0, 3, spread, spread, {.low = -1.0, .high = 1.0}, 0.9).cp.value();
  EXPECT_TRUE(is_close_relative(got.low, got.value * std::sqrt(-std::log(0.95)), rounding));
  EXPECT_TRUE(is_close_relative(got.high, got.value * std::sqrt(-std::log(0.05)), rounding));
}

// Seed 11; 4000 samples of 50. C_p is exact; Bissell's interval is an approximation, known to be
// good within a percent or so from n = 30 on.
TEST(Capability, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const std::size_t samples = test::trials(4000), n = 50;
  constexpr double approximation = 0.01;
  const double chance = test::chance_about_95_percent(samples, 4.0);
  std::mt19937_64 random(11);
  std::normal_distribution<double> values(0.5, 1.0);
  const Interval limits{.low = -3.0, .high = 4.5};
  std::size_t cp = 0, cpk = 0;
  for (std::size_t sample = 0; sample < samples; ++sample) {
    RunningStatistics statistics;
    for (std::size_t i = 0; i < n; ++i) {
      statistics.add(values(random));
    }
    const EstimatedSpread spread{.value = statistics.result().standard_deviation,
                                 .degrees_of_freedom = double(n - 1)};
    const Capability got = capability(statistics.result().mean, n, spread, spread, limits);
    cp += got.cp->low <= 7.5 / 6.0 && 7.5 / 6.0 <= got.cp->high;
    cpk += got.cpk->low <= 3.5 / 3.0 && 3.5 / 3.0 <= got.cpk->high;
  }
  EXPECT_TRUE(is_close(double(cp) / double(samples), 0.95, chance));
  EXPECT_TRUE(is_close(double(cpk) / double(samples), 0.95, chance + approximation));
}

TEST(Capability, TellsWithinAndOverallApart) {
  const Capability got =
      capability(10.0, 30, {.value = 1.0, .degrees_of_freedom = 20.0},
                 {.value = 2.0, .degrees_of_freedom = 29.0}, {.low = 4.0, .high = 22.0});
  EXPECT_TRUE(is_close_relative(got.cp->value, 3.0, rounding));
  EXPECT_TRUE(is_close_relative(got.cpk->value, 2.0, rounding));
  EXPECT_TRUE(is_close_relative(got.pp->value, 1.5, rounding));
  EXPECT_TRUE(is_close_relative(got.ppk->value, 1.0, rounding));
  EXPECT_TRUE(
      is_close_relative(got.expected_beyond, normal_below(-3.0) + normal_below(-6.0), rounding));
}

TEST(Capability, WithOneLimitHasNoCp) {
  const EstimatedSpread spread{.value = 2.0, .degrees_of_freedom = 9.0};
  const Capability low = capability(5.0, 10, spread, spread, {.low = -1.0});
  const Capability high = capability(-5.0, 10, spread, spread, {.high = 1.0});
  EXPECT_FALSE(low.cp || low.pp || high.cp || high.pp);
  EXPECT_EQ(low.cpk, high.cpk);
  EXPECT_EQ(low.cpk->value, 1.0);
  EXPECT_TRUE(is_close_relative(low.expected_beyond, normal_below(-3.0), rounding));
}

TEST(Capability, OfAMeanBeyondALimitIsNegative) {
  const EstimatedSpread spread{.value = 1.0, .degrees_of_freedom = 9.0};
  const Capability got = capability(13.0, 10, spread, spread, {.low = 0.0, .high = 10.0});
  EXPECT_EQ(got.cpk->value, -1.0);
  EXPECT_LT(got.cpk->low, -1.0);
  EXPECT_GT(got.cpk->high, -1.0);
  EXPECT_TRUE(is_close_relative(got.expected_beyond, normal_below(3.0), rounding));
}

TEST(Capability, WithoutSpreadHasNoIndices) {
  const Capability in = capability(5.0, 4, {}, {}, {.low = 0.0, .high = 10.0});
  EXPECT_FALSE(in.cp || in.cpk || in.pp || in.ppk);
  EXPECT_EQ(in.expected_beyond, 0.0);
  EXPECT_EQ(capability(11.0, 4, {}, {}, {.low = 0.0, .high = 10.0}).expected_beyond, 1.0);
}

TEST(Capability, RefusesWhatItCannotJudge) {
  const EstimatedSpread spread{.value = 1.0, .degrees_of_freedom = 9.0};
  const Interval limits{.low = 0.0, .high = 10.0};
  const auto message = [](auto... arguments) {
    return test::message_of([&] { (void)capability(arguments...); });
  };
  EXPECT_EQ(message(5.0, 10, spread, spread, Interval{}),
            "capability: expected a limit, found none");
  EXPECT_EQ(message(5.0, 10, spread, spread, Interval{.low = 2.0, .high = 2.0}),
            "capability: expected limits in order, found 2 and 2");
  EXPECT_EQ(message(5.0, 1, spread, spread, limits),
            "capability: expected the mean of two values or more, found 5 of 1");
  EXPECT_EQ(message(5.0, 10, EstimatedSpread{.value = -1.0}, spread, limits),
            "capability: expected a spread >= 0, found -1");
  EXPECT_EQ(message(5.0, 10, spread, EstimatedSpread{.value = 1.0}, limits),
            "capability: expected degrees of freedom > 0, found 0");
  EXPECT_THROW((void)capability(5.0, 10, spread, spread, limits, 1.0), std::domain_error);
}

}  // namespace
}  // namespace gonio

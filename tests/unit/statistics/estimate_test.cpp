#include "emulator/statistics/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::is_close_relative;

// What a sum of doubles and an inverted beta function leave.
constexpr double rounding = 1e-10;

double exactly(std::size_t k, std::size_t n, double p) {
  const double a = double(n) + 1.0, b = double(k) + 1.0;
  return std::exp(std::lgamma(a) - std::lgamma(b) - std::lgamma(a - b + 1.0) +
                  double(k) * std::log(p) + double(n - k) * std::log1p(-p));
}

double sum_of(std::size_t from, std::size_t to, std::size_t n, double p) {
  double sum = 0.0;
  for (std::size_t k = from; k <= to; ++k) {
    sum += exactly(k, n, p);
  }
  return sum;
}

// That is what the interval of Clopper and Pearson is: at each end, as many successes or more (at
// the lower one; or fewer) have half of what the confidence leaves. Biometrika 26, 404 (1934).
TEST(Proportion, LeavesEqualBinomialTailsAtBothEnds) {
  for (const std::size_t n : {5u, 50u, 400u}) {
    for (const std::size_t k : {std::size_t(1), n / 5, n / 2, n - 1}) {
      for (const double confidence : {0.9, 0.95, 0.99}) {
        const Estimate got = proportion(k, n, confidence);
        const double tail = (1.0 - confidence) / 2.0;
        EXPECT_EQ(got.value, double(k) / double(n));
        EXPECT_TRUE(is_close_relative(sum_of(k, n, n, got.low), tail, rounding))
            << k << " of " << n;
        EXPECT_TRUE(is_close_relative(sum_of(0, k, n, got.high), tail, rounding))
            << k << " of " << n;
      }
    }
  }
}

TEST(Proportion, OfNoneOrAllHasClosedForms) {
  for (const std::size_t n : {1u, 10u, 1000u}) {
    const double bound = 1.0 - std::pow(0.025, 1.0 / double(n));
    const Estimate none = proportion(0, n), all = proportion(n, n);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_TRUE(is_close_relative(none.high, bound, rounding));
    EXPECT_EQ(all.high, 1.0);
    EXPECT_TRUE(is_close_relative(all.low, 1.0 - bound, rounding));
  }
}

TEST(Proportion, OfSuccessesAndOfFailuresMirrorEachOther) {
  const Estimate successes = proportion(7, 40), failures = proportion(33, 40);
  EXPECT_TRUE(is_close_relative(successes.low, 1.0 - failures.high, rounding));
  EXPECT_TRUE(is_close_relative(successes.high, 1.0 - failures.low, rounding));
}

TEST(Proportion, IsRefusedWithoutTrialsOrWithTooManySuccesses) {
  EXPECT_THROW((void)proportion(0, 0), std::domain_error);
  EXPECT_THROW((void)proportion(1, 2, 1.0), std::domain_error);
  EXPECT_THROW((void)proportion(1, 2, 0.0), std::domain_error);
  EXPECT_EQ(test::message_of([] { (void)proportion(6, 5); }),
            "proportion: expected successes among at least one trial, found 6 of 5");
}

}  // namespace
}  // namespace gonio

#include "emulator/statistics/within_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "emulator/statistics/normal.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-12;

TEST(WithinLimits, IsThatOfNormalTails) {
  EXPECT_EQ(within_limits(3.0, 2.0, {}), 1.0);
  EXPECT_TRUE(
      is_close_relative(within_limits(3.0, 2.0, {.high = 5.0}), normal_below(1.0), rounding));
  EXPECT_TRUE(
      is_close_relative(within_limits(3.0, 2.0, {.low = 5.0}), normal_below(-1.0), rounding));
  EXPECT_TRUE(is_close_relative(within_limits(3.0, 2.0, {.low = -1.0, .high = 7.0}),
                                std::erf(2.0 / std::numbers::sqrt2), rounding));
}

TEST(WithinLimits, KeepsItsDigitsInBothTails) {
  for (const double mean : {-40.0, 40.0}) {
    const double got = within_limits(mean, 2.0, {.low = -2.0, .high = 2.0});
    EXPECT_TRUE(is_close_relative(got, normal_below(-19.0) - normal_below(-21.0), rounding));
  }
}

TEST(WithinLimits, AndBeyondAddUpToOne) {
  for (const double mean : {-9.0, 0.0, 0.3, 8.0}) {
    for (const Interval& limits : {Interval{}, Interval{.low = 1.0}, Interval{.high = 1.0},
                                   Interval{.low = -1.0, .high = 2.0}}) {
      for (const double sd : {0.0, 0.5, 20.0}) {
        EXPECT_TRUE(is_close(within_limits(mean, sd, limits) + beyond_limits(mean, sd, limits), 1.0,
                             rounding));
      }
    }
  }
}

TEST(WithinLimits, OfOneValueIsYesOrNo) {
  const Interval limits{.low = 1.0, .high = 2.0};
  EXPECT_EQ(within_limits(1.0, 0.0, limits), 1.0);
  EXPECT_EQ(within_limits(2.0, 0.0, limits), 1.0);
  EXPECT_EQ(within_limits(2.1, 0.0, limits), 0.0);
  EXPECT_EQ(beyond_limits(2.1, 0.0, limits), 1.0);
}

TEST(WithinLimits, OfLimitsOutOfOrderIsNothing) {
  for (const double mean : {-5.0, 1.5, 5.0}) {
    EXPECT_EQ(within_limits(mean, 1.0, {.low = 2.0, .high = 1.0}), 0.0);
    EXPECT_EQ(beyond_limits(mean, 1.0, {.low = 2.0, .high = 1.0}), 1.0);
    EXPECT_EQ(within_limits(mean, 0.0, {.low = 2.0, .high = 1.0}), 0.0);
  }
  EXPECT_EQ(test::message_of([] { (void)within_limits(0.0, -1.0, {}); }),
            "within_limits: expected sd >= 0, found -1");
}

}  // namespace
}  // namespace gonio

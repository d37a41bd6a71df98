#include "emulator/statistics/global_risks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "emulator/statistics/normal.hpp"
#include "emulator/statistics/within_limits.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;
constexpr double integrated = 1e-9;  // what the quadrature is asked for, and a digit

// The limit at the mean, no guard band: an item and its reading lie on both sides of it with the
// share of the angle between them, arccos(correlation) / 2 pi.
TEST(GlobalRisks, OfALimitAtTheMeanAreAnAngle) {
  for (const double u : {1e-6, 0.01, 0.5, 2.0, 1e3}) {
    const GlobalRisks got = global_risks(7.0, 2.0, u, {.high = 7.0}, {.high = 7.0});
    const double angle = std::atan(u / 2.0) / (2.0 * pi);
    EXPECT_TRUE(is_close(got.consumer, angle, integrated)) << u;
    EXPECT_TRUE(is_close(got.producer, angle, integrated)) << u;
  }
}

// Conforming and accepted is what conforms less what is rejected, and what is accepted less what
// does not conform; and a reading is normal as well.
TEST(GlobalRisks, AgreeWithWhatConformsAndWhatIsAccepted) {
  for (const double mean : {85.0, 82.5, 60.0}) {
    for (const double u : {1e-9, 0.05, 1.0, 30.0}) {
      for (const double guard : {-0.5, 0.0, 0.7, 2.9}) {
        const Interval tolerance{.low = 82.0, .high = 88.0};
        const Interval acceptance{.low = 82.0 + guard, .high = 88.0 - guard};
        const GlobalRisks got = global_risks(mean, 1.5, u, tolerance, acceptance);
        EXPECT_TRUE(is_close(within_limits(mean, 1.5, tolerance) - got.producer,
                             within_limits(mean, std::hypot(1.5, u), acceptance) - got.consumer,
                             integrated))
            << mean << " " << u << " " << guard;
        EXPECT_GE(got.consumer, 0.0);
        EXPECT_GE(got.producer, 0.0);
      }
    }
  }
}

// Seed 47; a million items.
TEST(GlobalRisks, AreWhatHappensToItemsThatAreDrawn) {
  const std::size_t items = test::trials(1000000);
  const double mean = 84.0, sd = 1.6, u = 0.7;
  std::mt19937_64 random(47);
  std::normal_distribution<double> normal;
  std::size_t consumer = 0, producer = 0;
  for (std::size_t i = 0; i < items; ++i) {
    const double item = mean + sd * normal(random), reading = item + u * normal(random);
    const bool conforms = 82.0 <= item && item <= 88.0;
    const bool accepted = 82.5 <= reading && reading <= 87.5;
    consumer += accepted && !conforms;
    producer += conforms && !accepted;
  }
  const GlobalRisks got =
      global_risks(mean, sd, u, {.low = 82.0, .high = 88.0}, {.low = 82.5, .high = 87.5});
  const auto close = [&](std::size_t count, double expected) {
    return is_close(double(count) / double(items), expected,
                    4.0 * std::sqrt(expected / double(items)));
  };
  EXPECT_TRUE(close(consumer, got.consumer));
  EXPECT_TRUE(close(producer, got.producer));
}

TEST(GlobalRisks, OfAPerfectMeasurementAreThoseOfTheGuardBand) {
  const Interval tolerance{.low = 82.0, .high = 88.0};
  const GlobalRisks none = global_risks(84.0, 1.5, 0.0, tolerance, tolerance);
  EXPECT_EQ(none.consumer, 0.0);
  EXPECT_EQ(none.producer, 0.0);
  const GlobalRisks guarded = global_risks(84.0, 1.5, 0.0, tolerance, {.low = 83.0, .high = 87.0});
  EXPECT_EQ(guarded.consumer, 0.0);
  EXPECT_TRUE(is_close(guarded.producer,
                       within_limits(84.0, 1.5, {.low = 82.0, .high = 83.0}) +
                           within_limits(84.0, 1.5, {.low = 87.0, .high = 88.0}),
                       integrated));
}

TEST(GlobalRisks, FallForTheConsumerAndRiseForTheProducerWithTheGuardBand) {
  GlobalRisks last = {.consumer = 1.0, .producer = 0.0};
  for (const double guard : {-1.0, -0.2, 0.0, 0.3, 1.0, 2.0}) {
    const GlobalRisks got = global_risks(83.0, 1.5, 0.4, {.low = 82.0}, {.low = 82.0 + guard});
    EXPECT_LT(got.consumer, last.consumer);
    EXPECT_GT(got.producer, last.producer);
    last = got;
  }
}

TEST(GlobalRisks, OfAGuardBandThatLeavesNothingRejectAll) {
  const Interval tolerance{.low = 82.0, .high = 88.0};
  const GlobalRisks got = global_risks(84.0, 1.5, 0.4, tolerance, {.low = 85.5, .high = 84.5});
  EXPECT_EQ(got.consumer, 0.0);
  EXPECT_TRUE(is_close(got.producer, within_limits(84.0, 1.5, tolerance), integrated));
}

TEST(GlobalRisks, OfEqualItemsAreThoseOfTheMeasurement) {
  const Interval limits{.high = 10.0};
  const GlobalRisks good = global_risks(9.0, 0.0, 0.5, limits, limits);
  EXPECT_TRUE(is_close_relative(good.producer, normal_below(-2.0), rounding));
  EXPECT_EQ(good.consumer, 0.0);
  const GlobalRisks bad = global_risks(11.0, 0.0, 0.5, limits, limits);
  EXPECT_TRUE(is_close_relative(bad.consumer, normal_below(-2.0), rounding));
  EXPECT_EQ(bad.producer, 0.0);
}

TEST(GlobalRisks, RefuseNegativeSpreads) {
  EXPECT_EQ(test::message_of([] { (void)global_risks(0.0, 1.0, -0.1, {}, {}); }),
            "global_risks: expected sd and u >= 0, found 1 and -0.1");
  EXPECT_THROW((void)global_risks(0.0, -1.0, 0.1, {}, {}), std::domain_error);
}

}  // namespace
}  // namespace gonio

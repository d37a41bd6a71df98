#include "emulator/instrument/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-14;
constexpr double hour_s = 3600.0;
constexpr double for_ever_s = 1e9;

Behaviour drifting() {
  Behaviour behaviour;
  behaviour.warm_up_s = 30.0;
  behaviour.warm_up_loss = 0.02;
  behaviour.drift_per_h = 0.0002;
  behaviour.drift_limit = 0.004;
  return behaviour;
}

// The lamp.

TEST(LampFactor, IsExactlyOneWithoutLosses) {
  Behaviour at_once = Behaviour().ideal();
  for (const Behaviour& behaviour : {Behaviour(), at_once}) {
    for (const double t_s : {0.0, 1e-9, 1.0, 12345.678, for_ever_s}) {
      EXPECT_EQ(lamp_factor(behaviour, t_s), 1.0) << t_s;
    }
  }
}

TEST(LampFactor, EqualsItsFormula) {
  for (const double t_s : {0.0, 0.1, 7.0, 30.0, 600.0, hour_s, 8 * hour_s, 24 * hour_s}) {
    const double expected = (1.0 - 0.02 * std::exp(-5.0 * t_s / 30.0)) *
                            (1.0 - 0.004 * (1.0 - std::exp(-0.0002 * t_s / hour_s / 0.004)));
    EXPECT_TRUE(is_close(lamp_factor(drifting(), t_s), expected, rounding)) << t_s;
  }
}

TEST(LampFactor, BeginsWithTheLossOfAColdLampAndEndsWithTheLimitOfTheDrift) {
  EXPECT_EQ(lamp_factor(drifting(), 0.0), 0.98);
  EXPECT_TRUE(is_close(lamp_factor(drifting(), for_ever_s), 0.996, rounding));
}

TEST(LampFactor, LosesAtFirstWhatIsStatedPerHour) {
  Behaviour behaviour = drifting();
  behaviour.warm_up_loss = 0.0;
  constexpr double short_h = 1e-3;
  constexpr double second_order = 1e-4;  // drift_per_h * short_h / drift_limit, rounded up
  EXPECT_TRUE(is_close_relative((1.0 - lamp_factor(behaviour, short_h * hour_s)) / short_h, 0.0002,
                                second_order));
}

// Temperature.

TEST(TemperatureC, RisesFromAmbientByTheSelfHeating) {
  Behaviour behaviour;
  behaviour.ambient_c = 21.5;
  behaviour.self_heating_k = 6.0;
  EXPECT_EQ(temperature_c(behaviour, 0.0), 21.5);
  EXPECT_TRUE(
      is_close(temperature_c(behaviour, 600.0), 21.5 + 6.0 * (1.0 - std::exp(-1.0)), 1e-13));
  EXPECT_TRUE(is_close(temperature_c(behaviour, for_ever_s), 27.5, 1e-13));
}

TEST(CleanSignal, ChangesWithTemperatureFrom23Degrees) {
  Behaviour behaviour;
  behaviour.signal_per_k = -0.0003;
  EXPECT_EQ(clean_signal_gu(behaviour, 0, 83.3, 0.0, 0.0), 83.3);
  behaviour.ambient_c = 33.0;
  EXPECT_TRUE(is_close(clean_signal_gu(behaviour, 0, 83.3, 0.0, 0.0), 83.3 * 0.997, 1e-12));
}

// Linearity.

TEST(LinearityError, IsLargestInTheMiddleOfTheScaleAndNoneAtItsEnds) {
  Behaviour behaviour;
  behaviour.linearity = 0.0005;
  behaviour.full_scale_gu = {2000.0, 160.0};
  EXPECT_EQ(linearity_error_gu(behaviour, 0, 0.0), 0.0);
  EXPECT_EQ(linearity_error_gu(behaviour, 0, 2000.0), 0.0);
  EXPECT_TRUE(is_close(linearity_error_gu(behaviour, 0, 1000.0), 1.0, rounding));
  EXPECT_TRUE(is_close(linearity_error_gu(behaviour, 1, 80.0), 0.08, rounding));
  for (double gloss_gu = 0.0; gloss_gu <= 2000.0; gloss_gu += 10.0) {
    EXPECT_LE(linearity_error_gu(behaviour, 0, gloss_gu), 1.0) << gloss_gu;
  }
}

TEST(LinearityError, IsNoneWithoutAFullScale) {
  Behaviour behaviour;
  behaviour.linearity = 0.01;
  EXPECT_EQ(linearity_error_gu(behaviour, 0, 50.0), 0.0);
}

TEST(CleanSignal, IsWhatTheOpticsReadToTheLastBitWithoutDeviations) {
  const Behaviour ideal = drifting().ideal();
  for (const double gloss_gu : {0.0, 0.1434930766626433, 83.38410071616812, 2037.6018812275238}) {
    for (const double t_s : {0.0, 17.3, 8 * hour_s}) {
      EXPECT_EQ(clean_signal_gu(ideal, 0, gloss_gu, 0.0, t_s), gloss_gu);
    }
  }
}

TEST(CleanSignal, AddsStrayLightToTheLightOfTheLamp) {
  Behaviour behaviour = drifting();
  behaviour.drift_limit = 0.0;
  EXPECT_TRUE(is_close(clean_signal_gu(behaviour, 0, 50.0, 0.4, 0.0), 0.98 * 50.4, 1e-13));
}

// Noise. Seed 1, 10,000 readings, significance 1e-6 (two sides: 4.9 standard deviations).

constexpr std::uint64_t seed = 1;
constexpr int count = 10'000;
constexpr double bound = 4.9;

TEST(NormalNoise, HasMean0AndStandardDeviation1) {
  RunningStatistics noise;
  double fourth = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = normal_noise(seed, 0, std::uint64_t(i));
    noise.add(x);
    fourth += x * x * x * x / count;
  }
  const double variance = std::pow(noise.result().standard_deviation, 2);
  EXPECT_TRUE(is_close(noise.result().mean, 0.0, bound / std::sqrt(count)));
  // (n - 1) s^2 is chi-square distributed: mean n - 1, variance 2 (n - 1).
  EXPECT_TRUE(is_close(variance, 1.0, bound * std::sqrt(2.0 / (count - 1))));
  // The fourth moment of a normal distribution is 3, that of x^4 about it 96.
  EXPECT_TRUE(is_close(fourth, 3.0, bound * std::sqrt(96.0 / count)));
}

TEST(NormalNoise, IsIndependentOfOtherReadingsChannelsAndSeeds) {
  double next_reading = 0.0;
  double next_channel = 0.0;
  double next_seed = 0.0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double x = normal_noise(seed, 0, i);
    next_reading += x * normal_noise(seed, 0, i + 1) / count;
    next_channel += x * normal_noise(seed, 1, i) / count;
    next_seed += x * normal_noise(seed + 1, 0, i) / count;
  }
  const double limit = bound / std::sqrt(count);
  EXPECT_TRUE(is_close(next_reading, 0.0, limit));
  EXPECT_TRUE(is_close(next_channel, 0.0, limit));
  EXPECT_TRUE(is_close(next_seed, 0.0, limit));
}

TEST(NormalNoise, DependsOnNothingButItsArguments) {
  const double first = normal_noise(seed, 2, 17);
  (void)normal_noise(seed, 2, 18);
  EXPECT_EQ(normal_noise(seed, 2, 17), first);
  EXPECT_NE(normal_noise(seed, 2, 18), first);
}

}  // namespace
}  // namespace gonio

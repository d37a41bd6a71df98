#include "emulator/instrument/measuring_head.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "emulator/instrument/signal.hpp"
#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::three_channels;
using test::three_samples;
using test::unhurried;

constexpr double rounding = 1e-12;
const std::vector<double> tile_gu{100.0, 100.0, 100.0};

MeasuringHead head_of(const Behaviour& behaviour) {
  return {behaviour, three_channels(), three_samples()};
}

MeasuringHead::Finding calibrate(MeasuringHead& head, double t_s = 0.0) {
  head.place(PortCover::tile, 0);
  return head.calibrate(t_s, t_s + 3.0, tile_gu);
}

// Exactness.

TEST(MeasuringHead, ReadsWhatTheOpticsReadToTheLastBit) {
  MeasuringHead head = head_of(unhurried());
  for (const bool is_calibrated : {false, true}) {
    if (is_calibrated) {
      EXPECT_TRUE(calibrate(head, 17.1).is_accepted);
    }
    for (int sample = 0; sample < 3; ++sample) {
      head.place(PortCover::sample, sample);
      const auto readings = head.read(123.456);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(readings[i].status, ReadingStatus::valid);
        EXPECT_EQ(readings[i].gloss_gu, head.samples()[std::size_t(sample)].gloss_gu[i]);
      }
    }
  }
}

TEST(MeasuringHead, ReadsNoLightFromAnOpenPortAndATrap) {
  MeasuringHead head = head_of(unhurried());
  for (const PortCover cover : {PortCover::nothing, PortCover::black_trap}) {
    head.place(cover, 0);
    EXPECT_EQ(head.read(1.0)[1].gloss_gu, 0.0);
  }
}

TEST(MeasuringHead, SeesAmbientLightOnlyThroughAnOpenPort) {
  Behaviour behaviour = unhurried();
  behaviour.stray_light_gu = 0.25;
  behaviour.ambient_light_gu = 0.5;
  MeasuringHead head = head_of(behaviour);
  EXPECT_EQ(head.read(1.0)[0].gloss_gu, 0.75);
  head.place(PortCover::black_trap, 0);
  EXPECT_EQ(head.read(1.0)[0].gloss_gu, 0.25);
}

// Calibration.

TEST(MeasuringHeadCalibration, MakesTheTileReadItsAssignedValue) {
  Behaviour behaviour = unhurried();
  behaviour.warm_up_loss = 0.009;
  behaviour.warm_up_s = 1e9;  // a lamp that stays as cold as it is
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::tile, 0);
  EXPECT_TRUE(is_close(head.read(1.0)[1].gloss_gu, 99.1, 1e-6));
  EXPECT_TRUE(calibrate(head).is_accepted);
  EXPECT_TRUE(is_close(head.read(1.0)[1].gloss_gu, 100.0, 1e-6));
}

TEST(MeasuringHeadCalibration, FindsTheGlossThatADirtyTileHasLost) {
  Behaviour behaviour = unhurried();
  behaviour.tile_contamination = 0.005;
  MeasuringHead head = head_of(behaviour);
  const auto found = calibrate(head);
  EXPECT_TRUE(found.is_accepted);
  for (const double deviation_gu : found.by_channel_gu) {
    EXPECT_TRUE(is_close(deviation_gu, -0.5, rounding));
  }
  // What it reads from now on is too high by what the tile has lost.
  head.place(PortCover::sample, test::paint);
  EXPECT_TRUE(is_close(head.read(9.0)[1].gloss_gu, test::paint_gu[1] / 0.995, rounding));
}

TEST(MeasuringHeadCalibration, OnATileThatIsTooDirtyIsRefusedAndChangesNothing) {
  Behaviour behaviour = unhurried();
  behaviour.tile_contamination = 0.02;
  MeasuringHead head = head_of(behaviour);
  const auto found = calibrate(head);
  EXPECT_FALSE(found.is_accepted);
  EXPECT_TRUE(is_close(found.by_channel_gu[2], -2.0, rounding));
  head.place(PortCover::sample, test::paint);
  EXPECT_EQ(head.read(9.0)[1].gloss_gu, test::paint_gu[1]);
}

TEST(MeasuringHeadCalibration, IsRefusedForAllChannelsIfOneIsOut) {
  MeasuringHead head = head_of(unhurried());
  head.place(PortCover::tile, 0);
  EXPECT_FALSE(head.calibrate(0.0, 3.0, {99.5, 100.0, 98.9}).is_accepted);
  EXPECT_EQ(head.read(9.0)[0].gloss_gu, 100.0);
  EXPECT_TRUE(head.calibrate(0.0, 3.0, {99.5, 100.0, 99.0}).is_accepted);
  EXPECT_TRUE(is_close(head.read(9.0)[0].gloss_gu, 99.5, rounding));
}

TEST(MeasuringHeadCalibration, WithoutAnySignalIsRefusedHoweverWideTheLimit) {
  Behaviour behaviour = unhurried();
  behaviour.tile_contamination = 1.0;
  behaviour.tile_limit_gu = 100.0;
  MeasuringHead head = head_of(behaviour);
  EXPECT_FALSE(calibrate(head).is_accepted);
}

TEST(MeasuringHeadCalibration, IsTheMeanOverItsTimeOfALampThatGetsBrighter) {
  Behaviour behaviour = unhurried();
  behaviour.warm_up_s = 5.0;
  behaviour.warm_up_loss = 0.01;
  MeasuringHead head = head_of(behaviour);
  double lamp = 0.0;
  for (const double t_s : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) {
    lamp += lamp_factor(behaviour, t_s) / 6.0;
  }
  EXPECT_TRUE(is_close(calibrate(head, 1.0).by_channel_gu[0], 100.0 * (lamp - 1.0), rounding));
}

// 3 s of 0.5 s are 6 readings. Seed 5; the noise of 2000 calibrations, significance 1e-6.
TEST(MeasuringHeadCalibration, AveragesTheNoiseOfAllReadingsThatItHasTimeFor) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.1;
  behaviour.seed = 5;
  MeasuringHead head = head_of(behaviour);
  constexpr int count = 2000;
  RunningStatistics deviations;
  for (int i = 0; i < count; ++i) {
    deviations.add(calibrate(head).by_channel_gu[0]);
  }
  const double variance = std::pow(deviations.result().standard_deviation, 2);
  EXPECT_TRUE(is_close(variance, 0.01 / 6.0, 4.9 * std::sqrt(2.0 / (count - 1)) * 0.01 / 6.0));
}

// Zero.

TEST(MeasuringHeadZero, TakesStrayLightAway) {
  Behaviour behaviour = unhurried();
  behaviour.stray_light_gu = 0.35;
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::black_trap, 0);
  const auto found = head.zero(0.0, 3.0);
  EXPECT_TRUE(found.is_accepted);
  EXPECT_EQ(found.by_channel_gu, std::vector<double>(3, 0.35));
  const auto deviation = calibrate(head).by_channel_gu;
  EXPECT_TRUE(is_close(deviation[0], 0.0, rounding));
  for (int sample = 0; sample < 3; ++sample) {
    head.place(PortCover::sample, sample);
    const auto readings = head.read(10.0);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(is_close(readings[i].gloss_gu, head.samples()[std::size_t(sample)].gloss_gu[i],
                           rounding));
    }
  }
}

TEST(MeasuringHeadZero, BeyondItsLimitIsRefusedAndChangesNothing) {
  Behaviour behaviour = unhurried();
  behaviour.stray_light_gu = std::nextafter(MeasuringHead::zero_limit_gu, 2.0);
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::black_trap, 0);
  EXPECT_FALSE(head.zero(0.0, 3.0).is_accepted);
  EXPECT_EQ(head.read(5.0)[0].gloss_gu, behaviour.stray_light_gu);
  behaviour.stray_light_gu = MeasuringHead::zero_limit_gu;
  head = head_of(behaviour);
  head.place(PortCover::black_trap, 0);
  EXPECT_TRUE(head.zero(0.0, 3.0).is_accepted);
}

TEST(MeasuringHead, ForgetsItsCalibrationOnReset) {
  MeasuringHead head = head_of(unhurried());
  head.place(PortCover::tile, 0);
  EXPECT_TRUE(head.calibrate(0.0, 3.0, {99.5, 99.5, 99.5}).is_accepted);
  head.reset();
  EXPECT_EQ(head.read(5.0)[0].gloss_gu, 100.0);
}

// What it shows.

TEST(MeasuringHead, RoundsToItsResolution) {
  Behaviour behaviour = unhurried();
  behaviour.resolution_gu = 0.1;
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::sample, test::paint);
  EXPECT_TRUE(is_close(head.read(1.0)[0].gloss_gu, 43.4, rounding));
  EXPECT_TRUE(is_close(head.read(1.0)[1].gloss_gu, 83.4, rounding));
  head.place(PortCover::sample, test::matt);
  EXPECT_TRUE(is_close(head.read(1.0)[0].gloss_gu, 0.1, rounding));
}

TEST(MeasuringHead, ShowsNoMinusZero) {
  Behaviour behaviour = unhurried();
  behaviour.resolution_gu = 1.0;
  behaviour.repeatability_gu = 0.1;
  MeasuringHead head = head_of(behaviour);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(std::signbit(head.read(1.0)[0].gloss_gu));
  }
}

// Seed 11, 3 channels of 4000 readings, significance 1e-6 each.
TEST(MeasuringHead, HasTheRepeatabilityThatIsStated) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.05;
  behaviour.seed = 11;
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::sample, test::paint);
  constexpr int count = 4000;
  std::vector<RunningStatistics> readings(3);
  for (int i = 0; i < count; ++i) {
    const auto values = head.read(1.0);
    for (std::size_t c = 0; c < 3; ++c) {
      readings[c].add(values[c].gloss_gu);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double variance = std::pow(readings[c].result().standard_deviation / 0.05, 2);
    EXPECT_TRUE(is_close(variance, 1.0, 4.9 * std::sqrt(2.0 / (count - 1)))) << c;
    EXPECT_TRUE(
        is_close(readings[c].result().mean, test::paint_gu[c], 4.9 * 0.05 / std::sqrt(count)))
        << c;
  }
}

TEST(MeasuringHead, IsOverRangeBeyondItsFullScale) {
  Behaviour behaviour = unhurried();
  behaviour.full_scale_gu = {2000.0, test::mirror_gu[1], 160.0};
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::sample, test::mirror);
  const auto readings = head.read(1.0);
  EXPECT_EQ(readings[0].status, ReadingStatus::over_range);
  EXPECT_EQ(readings[0].gloss_gu, 0.0);
  EXPECT_EQ(readings[1].status, ReadingStatus::valid);  // at its end is not beyond
  EXPECT_EQ(readings[2].status, ReadingStatus::over_range);
}

// Faults.

TEST(MeasuringHeadFault, OverRangeMakesEveryReadingSo) {
  MeasuringHead head = head_of(unhurried());
  EXPECT_TRUE(head.set_fault(InstrumentFault::over_range, true, 0.0));
  EXPECT_EQ(head.read(1.0)[1].status, ReadingStatus::over_range);
  EXPECT_TRUE(head.set_fault(InstrumentFault::over_range, false, 0.0));
  EXPECT_EQ(head.read(1.0)[1].status, ReadingStatus::valid);
}

TEST(MeasuringHeadFault, FrozenKeepsTheLastReading) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.05;
  MeasuringHead head = head_of(behaviour);
  head.place(PortCover::sample, test::paint);
  const double last = head.read(1.0)[1].gloss_gu;
  EXPECT_TRUE(head.set_fault(InstrumentFault::frozen_reading, true, 0.0));
  head.place(PortCover::sample, test::matt);
  EXPECT_EQ(head.read(2.0)[1].gloss_gu, last);
  EXPECT_TRUE(head.set_fault(InstrumentFault::frozen_reading, false, 0.0));
  EXPECT_LT(head.read(3.0)[1].gloss_gu, 3.0);
}

TEST(MeasuringHeadFault, FrozenFromTheBeginningKeepsTheFirstReading) {
  MeasuringHead head = head_of(unhurried());
  EXPECT_TRUE(head.set_fault(InstrumentFault::frozen_reading, true, 0.0));
  head.place(PortCover::sample, test::paint);
  EXPECT_EQ(head.read(1.0)[1].gloss_gu, test::paint_gu[1]);
  head.place(PortCover::sample, test::matt);
  EXPECT_EQ(head.read(2.0)[1].gloss_gu, test::paint_gu[1]);
}

TEST(MeasuringHeadFault, DriftStepScalesTheSignal) {
  MeasuringHead head = head_of(unhurried());
  EXPECT_TRUE(head.set_fault(InstrumentFault::drift_step, true, -0.03));
  head.place(PortCover::sample, test::paint);
  EXPECT_TRUE(is_close(head.read(1.0)[1].gloss_gu, 0.97 * test::paint_gu[1], rounding));
  EXPECT_TRUE(is_close(calibrate(head).by_channel_gu[0], -3.0, rounding));
}

TEST(MeasuringHeadFault, TileDirtyAddsToItsContamination) {
  Behaviour behaviour = unhurried();
  behaviour.tile_contamination = 0.1;
  MeasuringHead head = head_of(behaviour);
  EXPECT_TRUE(head.set_fault(InstrumentFault::tile_dirty, true, 0.2));
  EXPECT_TRUE(is_close(calibrate(head).by_channel_gu[0], 100.0 * 0.9 * 0.8 - 100.0, rounding));
  head.place(PortCover::sample, test::paint);
  EXPECT_EQ(head.read(1.0)[1].gloss_gu, test::paint_gu[1]);
}

TEST(MeasuringHeadFault, WithAMagnitudeOutOfItsRangeIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MeasuringHead head = head_of(unhurried());
  for (const double magnitude : {-1.01, 10.01, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(head.set_fault(InstrumentFault::drift_step, true, magnitude)) << magnitude;
    EXPECT_FALSE(head.is_on(InstrumentFault::drift_step));
  }
  for (const double magnitude : {-0.01, 1.01, nan}) {
    EXPECT_FALSE(head.set_fault(InstrumentFault::tile_dirty, true, magnitude)) << magnitude;
  }
  EXPECT_TRUE(head.set_fault(InstrumentFault::drift_step, false, nan));
  EXPECT_TRUE(head.set_fault(InstrumentFault::lamp_failure, true, nan));
}

// What it refuses to be built from.

TEST(MeasuringHead, NeedsOneValueForEachChannel) {
  Behaviour behaviour = unhurried();
  EXPECT_THROW(MeasuringHead(behaviour, {}, {}), std::invalid_argument);
  EXPECT_THROW(MeasuringHead(behaviour, three_channels(), {{"one", "One", {1.0, 2.0}}}),
               std::invalid_argument);
  behaviour.full_scale_gu = {2000.0, 1000.0};
  EXPECT_THROW(head_of(behaviour), std::invalid_argument);
  behaviour = unhurried();
  behaviour.faults = {{InstrumentFault::tile_dirty, 1.0, 1.5}};
  EXPECT_THROW(head_of(behaviour), std::invalid_argument);
}

TEST(MeasuringHead, HasNoSampleThatIsNotThere) {
  MeasuringHead head = head_of(unhurried());
  EXPECT_THROW(head.place(PortCover::sample, 3), std::out_of_range);
  EXPECT_THROW(head.place(PortCover::sample, -1), std::out_of_range);
  EXPECT_EQ(head.cover(), PortCover::nothing);
}

}  // namespace
}  // namespace gonio

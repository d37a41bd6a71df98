// What a measurement does in each mode.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "emulator/instrument/device.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"

namespace gonio {
namespace {

using test::calibrated;
using test::is_close;
using test::measure;
using test::reading_gu;
using test::run;
using test::set_mode;
using test::set_readings;
using test::unhurried;

constexpr double rounding = 1e-12;

TEST(StatisticsMode, ReadsAsOftenAsItIsSet) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.05;
  Device device = calibrated(behaviour);
  set_readings(device, 4);
  device.place(PortCover::sample, test::paint);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  EXPECT_EQ(device.status().readings_left, 4);
  std::vector<double> readings;
  for (int left = 3; left >= 0; --left) {
    device.advance(0.5);
    readings.push_back(reading_gu(device, 1));
    EXPECT_EQ(device.status().readings_left, left);
  }
  EXPECT_EQ(device.status().command.state, CommandState::done);
  const double mean = (readings[0] + readings[1] + readings[2] + readings[3]) / 4.0;
  double squares = 0.0;
  for (const double reading : readings) {
    squares += (reading - mean) * (reading - mean);
  }
  const ChannelStatistics got = device.status().channels[1].statistics;
  EXPECT_EQ(got.n, 4);
  EXPECT_TRUE(is_close(got.mean, mean, rounding));
  EXPECT_TRUE(is_close(got.standard_deviation, std::sqrt(squares / 3.0), rounding));
  EXPECT_EQ(got.minimum, *std::min_element(readings.begin(), readings.end()));
  EXPECT_EQ(got.maximum, *std::max_element(readings.begin(), readings.end()));
}

TEST(StatisticsMode, BeginsAnewWithEachMeasurement) {
  Device device = calibrated();
  set_readings(device, 3);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].statistics.n, 3);
  EXPECT_EQ(device.status().channels[1].statistics.mean, test::matt_gu[1]);
}

TEST(SingleMode, AddsToTheStatisticsUntilTheyAreCleared) {
  Device device = calibrated();
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  const ChannelStatistics two = device.status().channels[1].statistics;
  EXPECT_EQ(two.n, 2);
  EXPECT_EQ(two.range(), test::paint_gu[1] - test::matt_gu[1]);
  ASSERT_EQ(run(device, DeviceCommand::clear_statistics), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].statistics.n, 0);
  EXPECT_EQ(reading_gu(device, 1), test::matt_gu[1]);  // the reading stays
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].statistics.n, 1);
}

TEST(ContinuousMode, ReadsOnceAnIntervalUntilItIsStopped) {
  Device device = calibrated();
  set_mode(device, MeasuringMode::continuous);
  device.place(PortCover::sample, test::paint);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  device.advance(0.5);
  EXPECT_EQ(device.status().sequence, 1U);
  device.advance(9.9);
  EXPECT_EQ(device.status().sequence, 10U);
  device.place(PortCover::sample, test::matt);
  device.advance(0.1);
  EXPECT_EQ(device.status().sequence, 11U);
  EXPECT_EQ(reading_gu(device, 1), test::matt_gu[1]);
  EXPECT_EQ(device.status().channels[1].statistics.n, 11);
  EXPECT_EQ(device.status().state, DeviceState::measuring);
  EXPECT_EQ(device.status().readings_left, 0);
  ASSERT_TRUE(device.command(DeviceCommand::stop));
  EXPECT_EQ(device.status().state, DeviceState::idle);
  EXPECT_EQ(device.status().command.state, CommandState::done);
  device.advance(100.0);
  EXPECT_EQ(device.status().sequence, 11U);
}

TEST(ContinuousMode, ReadsNoFasterThanAReadingTakes) {
  Device device = calibrated();
  DeviceSettings settings = device.settings();
  settings.mode = MeasuringMode::continuous;
  settings.interval_s = 0.1;
  ASSERT_EQ(device.set(settings), std::nullopt);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  device.advance(10.0);
  EXPECT_EQ(device.status().sequence, 20U);
}

TEST(DifferenceMode, ShowsTheDifferenceToTheReference) {
  Device device = calibrated();
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].difference.status, ReadingStatus::not_measured);
  EXPECT_FALSE(device.status().is_reference_set);
  ASSERT_EQ(run(device, DeviceCommand::store_reference), DeviceError::none);
  EXPECT_TRUE(device.status().is_reference_set);
  EXPECT_EQ(device.settings().channels[1].reference_gu, test::paint_gu[1]);
  set_mode(device, MeasuringMode::difference);
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  EXPECT_EQ(reading_gu(device, 1), test::matt_gu[1]);
  EXPECT_EQ(device.status().channels[1].difference.status, ReadingStatus::valid);
  EXPECT_EQ(device.status().channels[1].difference.gloss_gu, test::matt_gu[1] - test::paint_gu[1]);
  EXPECT_TRUE(device.set_fault(InstrumentFault::over_range, true));
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].difference.status, ReadingStatus::over_range);
  EXPECT_EQ(device.status().channels[1].difference.gloss_gu, 0.0);
}

TEST(DifferenceMode, NeedsAReference) {
  Device device = calibrated();
  set_mode(device, MeasuringMode::difference);
  EXPECT_EQ(measure(device, test::paint), DeviceError::no_reference);
}

TEST(StoreReference, NeedsAValidReadingOfEachChannelThatIsMeasured) {
  Behaviour behaviour = unhurried();
  behaviour.full_scale_gu = {2000.0, 1000.0, 160.0};
  Device device = calibrated(behaviour);
  EXPECT_EQ(run(device, DeviceCommand::store_reference), DeviceError::no_reading);
  ASSERT_EQ(measure(device, test::mirror), DeviceError::none);
  const DeviceSettings before = device.settings();
  EXPECT_EQ(run(device, DeviceCommand::store_reference), DeviceError::no_reading);
  EXPECT_EQ(device.settings(), before);
  DeviceSettings only_60 = before;
  only_60.channels[0].is_measured = only_60.channels[2].is_measured = false;
  ASSERT_EQ(device.set(only_60), std::nullopt);
  ASSERT_EQ(measure(device, test::mirror), DeviceError::none);
  EXPECT_EQ(run(device, DeviceCommand::store_reference), DeviceError::none);
  EXPECT_EQ(device.settings().channels[1].reference_gu, test::mirror_gu[1]);
  EXPECT_EQ(device.settings().channels[0].reference_gu, 0.0);
}

TEST(StoreReference, RefusesAReadingThatNoSettingsCouldHold) {
  Device device = calibrated();
  EXPECT_TRUE(device.set_fault(InstrumentFault::drift_step, true, 10.0));
  ASSERT_EQ(measure(device, test::mirror), DeviceError::none);
  EXPECT_GT(reading_gu(device, 0), 10'000.0);
  EXPECT_EQ(run(device, DeviceCommand::store_reference), DeviceError::no_reading);
  EXPECT_FALSE(device.status().is_reference_set);
}

TEST(PassFailMode, JudgesEachChannelByItsLimits) {
  Device device = calibrated();
  DeviceSettings settings = device.settings();
  settings.mode = MeasuringMode::pass_fail;
  settings.channels[0].lower_limit_gu = 43.4;               // paint reads 43.387...
  settings.channels[1].lower_limit_gu = test::paint_gu[1];  // limits belong to what passes
  settings.channels[1].upper_limit_gu = test::paint_gu[1];
  settings.channels[2].upper_limit_gu = 90.8;  // 90.872...
  ASSERT_EQ(device.set(settings), std::nullopt);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(device.status().channels[0].verdict, Verdict::below);
  EXPECT_EQ(device.status().channels[1].verdict, Verdict::pass);
  EXPECT_EQ(device.status().channels[2].verdict, Verdict::above);
  settings.channels[0].is_measured = false;
  ASSERT_EQ(device.set(settings), std::nullopt);
  EXPECT_TRUE(device.set_fault(InstrumentFault::over_range, true));
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(device.status().channels[0].verdict, Verdict::none);
  EXPECT_EQ(device.status().channels[1].verdict, Verdict::above);
  set_mode(device, MeasuringMode::single);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(device.status().channels[1].verdict, Verdict::none);
}

}  // namespace
}  // namespace gonio

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <stdexcept>

#include "emulator/instrument/device.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"

namespace gonio {
namespace {

using test::calibrate;
using test::description;
using test::device_of;
using test::has_alarm;
using test::is_close;
using test::measure;
using test::reading_gu;
using test::run;
using test::set_mode;
using test::unhurried;
using test::zero;

constexpr double rounding = 1e-12;

Device calibrated(const Behaviour& behaviour = unhurried()) {
  Device device = device_of(behaviour);
  EXPECT_EQ(calibrate(device), DeviceError::none);
  return device;
}

void set_readings(Device& device, int n) {
  DeviceSettings settings = device.settings();
  settings.mode = MeasuringMode::statistics;
  settings.statistics_readings = n;
  EXPECT_EQ(device.set(settings), std::nullopt);
}

// Every command in every state.

/// A device in that state that has read, and is on its tile; calibrated unless it warms up.
Device device_in(DeviceState state) {
  Behaviour behaviour = unhurried();
  behaviour.warm_up_s = state == DeviceState::warm_up ? 30.0 : 0.0;
  Device device = device_of(behaviour);
  device.keep_settings([](const DeviceSettings&) {}, std::nullopt);
  if (state != DeviceState::warm_up) {
    EXPECT_EQ(calibrate(device), DeviceError::none);
    EXPECT_EQ(measure(device, test::paint), DeviceError::none);
  }
  device.place(PortCover::tile);
  if (state == DeviceState::measuring) {
    EXPECT_TRUE(device.command(DeviceCommand::measure));
  } else if (state == DeviceState::calibrating) {
    EXPECT_TRUE(device.command(DeviceCommand::calibrate));
  } else if (state == DeviceState::fault) {
    EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  }
  EXPECT_EQ(device.status().state, state);
  return device;
}

struct Expected {
  DeviceCommand command;
  DeviceError in_warm_up, in_idle, in_fault;
  bool is_taken_when_busy = false;
};

constexpr auto ok = DeviceError::none;
constexpr auto warming_up = DeviceError::warming_up;
constexpr auto lamp = DeviceError::lamp_failure;
constexpr auto unknown = DeviceError::unknown_command;

const std::array<Expected, 13> table{
    {{DeviceCommand::none, unknown, unknown, unknown},
     {DeviceCommand::measure, warming_up, ok, lamp},
     {DeviceCommand::calibrate, warming_up, ok, lamp},
     {DeviceCommand::zero, warming_up, DeviceError::not_on_trap, lamp},
     {DeviceCommand::stop, ok, ok, ok, true},
     {DeviceCommand::acknowledge_alarms, ok, ok, ok, true},
     {DeviceCommand::store_reference, DeviceError::no_reading, ok, ok},
     {DeviceCommand::clear_statistics, ok, ok, ok},
     {DeviceCommand::save_settings, ok, ok, ok},
     {DeviceCommand::restore_settings, ok, ok, ok},
     {DeviceCommand::factory_settings, ok, ok, ok},
     {DeviceCommand::restart, ok, ok, ok},
     {DeviceCommand(99), unknown, unknown, unknown}}};

TEST(DeviceCommands, AreTakenOrRefusedByTheState) {
  for (const Expected& row : table) {
    const std::map<DeviceState, DeviceError> expected{{DeviceState::warm_up, row.in_warm_up},
                                                      {DeviceState::idle, row.in_idle},
                                                      {DeviceState::fault, row.in_fault}};
    for (const auto& [state, error] : expected) {
      Device device = device_in(state);
      const auto sequence = device.status().command.sequence;
      ASSERT_TRUE(device.command(row.command));
      const CommandOutcome outcome = device.status().command;
      EXPECT_EQ(outcome.command, row.command);
      EXPECT_EQ(outcome.error, error) << int(row.command) << " in " << int(state);
      EXPECT_EQ(outcome.sequence, sequence + 1);
      EXPECT_EQ(outcome.state == CommandState::failed, error != ok);
    }
  }
}

TEST(DeviceCommands, OfABusyInstrumentChangeNothingExceptStopAndAcknowledge) {
  for (const DeviceState state : {DeviceState::calibrating, DeviceState::measuring}) {
    for (const Expected& row : table) {
      Device device = device_in(state);
      const std::string before = description(device);
      EXPECT_EQ(device.command(row.command), row.is_taken_when_busy)
          << int(row.command) << " in " << int(state);
      EXPECT_EQ(description(device) == before, !row.is_taken_when_busy);
    }
  }
}

TEST(DeviceCommands, CountAndWrap) {
  Device device = device_of(unhurried());
  for (int i = 0; i < 65536; ++i) {
    ASSERT_TRUE(device.command(DeviceCommand::stop));
    ASSERT_EQ(device.status().command.sequence, std::uint16_t(i + 1));
  }
}

// Measure.

TEST(MeasureCommand, TakesTheTimeOfAReading) {
  Device device = calibrated();
  device.place(PortCover::sample, test::paint);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  EXPECT_EQ(device.status().state, DeviceState::measuring);
  EXPECT_EQ(device.status().command.state, CommandState::running);
  EXPECT_EQ(device.status().readings_left, 1);
  device.advance(0.499999999);
  EXPECT_EQ(device.status().channels[1].reading.status, ReadingStatus::not_measured);
  device.advance(1e-9);
  EXPECT_EQ(device.status().state, DeviceState::idle);
  EXPECT_EQ(device.status().command.state, CommandState::done);
  EXPECT_EQ(device.status().readings_left, 0);
  EXPECT_EQ(device.status().sequence, 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reading_gu(device, i), test::paint_gu[i]);
  }
}

TEST(MeasureCommand, OfAnIdealInstrumentIsOverAtOnceAndExact) {
  Device device = device_of(test::with_everything().ideal());
  for (const bool is_calibrated : {false, true}) {
    if (is_calibrated) {
      device.place(PortCover::tile);
      ASSERT_TRUE(device.command(DeviceCommand::calibrate));
      EXPECT_EQ(device.status().command.state, CommandState::done);
    }
    device.place(PortCover::sample, test::mirror);
    ASSERT_TRUE(device.command(DeviceCommand::measure));
    EXPECT_EQ(device.status().command.state, CommandState::done);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(reading_gu(device, i), test::mirror_gu[i]);
    }
  }
  EXPECT_EQ(device.uptime_s(), 0.0);
}

TEST(MeasureCommand, NeedsACalibrationIfTheInstrumentInsists) {
  Behaviour behaviour = unhurried();
  Device strict = device_of(behaviour);
  EXPECT_EQ(measure(strict, test::paint), DeviceError::not_calibrated);
  EXPECT_EQ(strict.status().sequence, 0U);
  behaviour.calibration_required = false;
  Device lenient = device_of(behaviour);
  EXPECT_EQ(measure(lenient, test::paint), DeviceError::none);
  EXPECT_TRUE(lenient.status().is_calibration_due);
}

TEST(MeasureCommand, ReadsTheChannelsThatAreSetToBeMeasured) {
  Device device = calibrated();
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  DeviceSettings settings = device.settings();
  settings.channels[0].is_measured = false;
  settings.channels[2].is_measured = false;
  ASSERT_EQ(device.set(settings), std::nullopt);
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  EXPECT_EQ(device.status().channels[0].reading.status, ReadingStatus::not_measured);
  EXPECT_EQ(reading_gu(device, 1), test::matt_gu[1]);
  EXPECT_EQ(device.status().channels[2].reading.status, ReadingStatus::not_measured);
}

TEST(MeasureCommand, LatchesAnAlarmWhenOverRange) {
  Behaviour behaviour = unhurried();
  behaviour.full_scale_gu = {2000.0, 1000.0, 160.0};
  Device device = calibrated(behaviour);
  ASSERT_EQ(measure(device, test::mirror), DeviceError::none);
  EXPECT_EQ(device.status().channels[0].reading.status, ReadingStatus::over_range);
  EXPECT_EQ(device.status().channels[0].reading.gloss_gu, 0.0);
  EXPECT_EQ(device.status().channels[0].statistics.n, 0);
  EXPECT_EQ(reading_gu(device, 1), test::mirror_gu[1]);
  EXPECT_TRUE(has_alarm(device, Alarm::over_range));
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_TRUE(has_alarm(device, Alarm::over_range));
  ASSERT_EQ(run(device, DeviceCommand::acknowledge_alarms), DeviceError::none);
  EXPECT_EQ(device.status().alarms, 0U);
}

// Modes.

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

// Calibrate and zero.

TEST(CalibrateCommand, TakesItsTimeOnTheTile) {
  Device device = device_of(unhurried());
  device.place(PortCover::tile);
  ASSERT_TRUE(device.command(DeviceCommand::calibrate));
  EXPECT_EQ(device.status().state, DeviceState::calibrating);
  device.advance(2.9);
  EXPECT_FALSE(device.status().channels[0].is_calibrated);
  device.advance(0.1);
  EXPECT_EQ(device.status().state, DeviceState::idle);
  EXPECT_EQ(device.status().command.state, CommandState::done);
  EXPECT_EQ(device.since_calibration_s(), 0.0);
  for (const ChannelStatus& channel : device.status().channels) {
    EXPECT_TRUE(channel.is_calibrated);
    EXPECT_EQ(channel.calibration_deviation_gu, 0.0);
  }
}

TEST(CalibrateCommand, NeedsTheTileToItsEnd) {
  Device device = device_of(unhurried());
  for (const PortCover cover : {PortCover::nothing, PortCover::black_trap, PortCover::sample}) {
    device.place(cover);
    EXPECT_EQ(run(device, DeviceCommand::calibrate), DeviceError::not_on_tile);
  }
  device.place(PortCover::tile);
  ASSERT_TRUE(device.command(DeviceCommand::calibrate));
  device.advance(1.0);
  device.place(PortCover::nothing);
  device.advance(2.0);
  EXPECT_EQ(device.status().command.error, DeviceError::not_on_tile);
  EXPECT_TRUE(device.status().is_calibration_due);
}

TEST(CalibrateCommand, OnADirtyTileIsRefusedAndTheOldCalibrationStays) {
  Device device = calibrated();
  device.advance(60.0);
  EXPECT_TRUE(device.set_fault(InstrumentFault::tile_dirty, true, 0.02));
  EXPECT_EQ(calibrate(device), DeviceError::tile_out_of_tolerance);
  EXPECT_TRUE(has_alarm(device, Alarm::tile_refused));
  EXPECT_TRUE(device.status().channels[0].is_calibrated);
  EXPECT_TRUE(is_close(device.status().channels[0].calibration_deviation_gu, -2.0, rounding));
  EXPECT_TRUE(is_close(device.since_calibration_s(), 63.0, rounding));
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_EQ(reading_gu(device, 1), test::paint_gu[1]);
  EXPECT_TRUE(device.set_fault(InstrumentFault::tile_dirty, true, 0.005));
  EXPECT_EQ(calibrate(device), DeviceError::none);
  EXPECT_TRUE(is_close(device.status().channels[0].calibration_deviation_gu, -0.5, rounding));
}

TEST(CalibrateCommand, ByAValueThatIsNotTheTilesIsRefused) {
  Device device = device_of(unhurried());
  DeviceSettings settings = device.settings();
  settings.channels[1].tile_gu = 93.6;
  ASSERT_EQ(device.set(settings), std::nullopt);
  EXPECT_EQ(calibrate(device), DeviceError::tile_out_of_tolerance);
  EXPECT_TRUE(is_close(device.status().channels[1].calibration_deviation_gu, 6.4, rounding));
}

TEST(CalibrateCommand, IsLeftAsItWasWhenStopped) {
  Device device = device_of(unhurried());
  device.place(PortCover::tile);
  ASSERT_TRUE(device.command(DeviceCommand::calibrate));
  device.advance(1.0);
  ASSERT_TRUE(device.command(DeviceCommand::stop));
  device.advance(10.0);
  EXPECT_FALSE(device.status().channels[0].is_calibrated);
  EXPECT_EQ(device.status().command.command, DeviceCommand::stop);
}

TEST(ZeroCommand, FindsTheStrayLightOnTheTrap) {
  Behaviour behaviour = unhurried();
  behaviour.stray_light_gu = 0.35;
  Device device = device_of(behaviour);
  ASSERT_EQ(zero(device), DeviceError::none);
  EXPECT_EQ(device.status().channels[2].zero_offset_gu, 0.35);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_TRUE(is_close(reading_gu(device, 1), test::paint_gu[1], rounding));
}

TEST(ZeroCommand, NeedsTheTrapToItsEnd) {
  Device device = device_of(unhurried());
  for (const PortCover cover : {PortCover::nothing, PortCover::tile, PortCover::sample}) {
    device.place(cover);
    EXPECT_EQ(run(device, DeviceCommand::zero), DeviceError::not_on_trap);
  }
  device.place(PortCover::black_trap);
  ASSERT_TRUE(device.command(DeviceCommand::zero));
  EXPECT_EQ(device.status().state, DeviceState::calibrating);
  device.place(PortCover::tile);
  device.advance(3.0);
  EXPECT_EQ(device.status().command.error, DeviceError::not_on_trap);
}

TEST(ZeroCommand, OfTooMuchLightIsRefused) {
  Behaviour behaviour = unhurried();
  behaviour.stray_light_gu = 1.5;
  Device device = device_of(behaviour);
  EXPECT_EQ(zero(device), DeviceError::zero_out_of_tolerance);
  EXPECT_TRUE(has_alarm(device, Alarm::zero_refused));
  EXPECT_EQ(device.status().channels[0].zero_offset_gu, 1.5);
}

// The outcome is that of the last command.

TEST(DeviceCommands, ThatComeWhileSomethingRunsAnswerForThemselves) {
  Device device = calibrated();
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  const auto sequence = device.status().command.sequence;
  ASSERT_TRUE(device.command(DeviceCommand::acknowledge_alarms));
  device.advance(1.0);
  EXPECT_EQ(device.status().sequence, 1U);  // it was measured all the same
  EXPECT_EQ(device.status().command.command, DeviceCommand::acknowledge_alarms);
  EXPECT_EQ(device.status().command.state, CommandState::done);
  EXPECT_EQ(device.status().command.sequence, sequence + 1);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  ASSERT_TRUE(device.command(DeviceCommand::acknowledge_alarms));
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  EXPECT_EQ(device.status().command.state, CommandState::done);  // the measurement failed
  EXPECT_EQ(device.status().command.error, DeviceError::none);
}

// Settings.

TEST(SaveSettings, KeepsWhatIsInForceAndRestoreBringsItBack) {
  std::optional<DeviceSettings> stored;
  Device device = device_of(unhurried());
  device.keep_settings([&](const DeviceSettings& settings) { stored = settings; }, std::nullopt);
  set_readings(device, 9);
  const DeviceSettings kept = device.settings();
  ASSERT_EQ(run(device, DeviceCommand::save_settings), DeviceError::none);
  EXPECT_EQ(stored, kept);
  set_readings(device, 3);
  ASSERT_EQ(run(device, DeviceCommand::restore_settings), DeviceError::none);
  EXPECT_EQ(device.settings(), kept);
  ASSERT_EQ(run(device, DeviceCommand::factory_settings), DeviceError::none);
  EXPECT_EQ(device.settings(), device.factory_settings());
  EXPECT_EQ(stored, kept);  // volatile until saved
  ASSERT_EQ(run(device, DeviceCommand::restart), DeviceError::none);
  EXPECT_EQ(device.settings(), kept);
}

TEST(SaveSettings, FailsWithAlarmAndKeepsTheOldOnesIfTheStoreFails) {
  Device device = device_of(unhurried());
  EXPECT_EQ(run(device, DeviceCommand::save_settings), DeviceError::storage_failed);
  DeviceSettings old = device.settings();
  old.statistics_readings = 8;
  bool is_thrown = false;
  device.keep_settings(
      [&](const DeviceSettings&) {
        is_thrown = true;
        throw std::runtime_error("disk full");
      },
      old);
  ASSERT_EQ(run(device, DeviceCommand::acknowledge_alarms), DeviceError::none);
  set_readings(device, 2);
  EXPECT_EQ(run(device, DeviceCommand::save_settings), DeviceError::storage_failed);
  EXPECT_TRUE(is_thrown);
  EXPECT_TRUE(has_alarm(device, Alarm::storage_failed));
  EXPECT_EQ(device.settings().statistics_readings, 2);
  ASSERT_EQ(run(device, DeviceCommand::restore_settings), DeviceError::none);
  EXPECT_EQ(device.settings(), old);
}

TEST(RestoreSettings, AreThoseOfTheFactoryIfNoneWereSaved) {
  Device device = device_of(unhurried());
  set_readings(device, 2);
  ASSERT_EQ(run(device, DeviceCommand::restore_settings), DeviceError::none);
  EXPECT_EQ(device.settings(), device.factory_settings());
}

// Restart.

TEST(RestartCommand, IsAsPowerOffAndOn) {
  Behaviour behaviour = unhurried();
  behaviour.warm_up_s = 5.0;
  Device device = device_of(behaviour);
  device.advance(5.0);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  ASSERT_EQ(run(device, DeviceCommand::acknowledge_alarms), DeviceError::none);
  set_readings(device, 2);
  const auto sequence = device.status().command.sequence;
  ASSERT_EQ(run(device, DeviceCommand::restart), DeviceError::none);
  EXPECT_EQ(device.status().state, DeviceState::warm_up);
  EXPECT_EQ(device.uptime_s(), 0.0);
  EXPECT_TRUE(has_alarm(device, Alarm::restarted));
  EXPECT_TRUE(device.status().is_calibration_due);
  EXPECT_EQ(device.status().sequence, 0U);
  EXPECT_EQ(device.status().channels[1].reading.status, ReadingStatus::not_measured);
  EXPECT_EQ(device.status().channels[1].statistics.n, 0);
  EXPECT_EQ(device.settings(), device.factory_settings());
  // What is no part of its memory stays.
  EXPECT_EQ(device.status().cover, PortCover::sample);
  EXPECT_EQ(device.status().sample, test::paint);
  EXPECT_EQ(device.status().command.command, DeviceCommand::restart);
  EXPECT_EQ(device.status().command.sequence, sequence + 1);
}

TEST(RestartCommand, RepairsNothing) {
  Device device = device_of(unhurried());
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  ASSERT_EQ(run(device, DeviceCommand::restart), DeviceError::none);
  EXPECT_EQ(device.status().state, DeviceState::fault);
  EXPECT_EQ(device.status().faults, 1U << unsigned(InstrumentFault::lamp_failure));
}

TEST(RestartCommand, DoesNotRepeatTheNoise) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.05;
  behaviour.calibration_required = false;
  Device device = device_of(behaviour);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  const double first = reading_gu(device, 1);
  ASSERT_EQ(run(device, DeviceCommand::restart), DeviceError::none);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_NE(reading_gu(device, 1), first);
}

}  // namespace
}  // namespace gonio

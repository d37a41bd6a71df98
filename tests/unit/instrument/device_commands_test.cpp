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
using test::calibrated;
using test::description;
using test::device_of;
using test::has_alarm;
using test::measure;
using test::reading_gu;
using test::run;
using test::set_readings;
using test::unhurried;

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

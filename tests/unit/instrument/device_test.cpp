#include "emulator/instrument/device.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "emulator/instrument/signal.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::calibrate;
using test::description;
using test::device_of;
using test::has_alarm;
using test::is_close;
using test::measure;
using test::message_of;
using test::reading_gu;
using test::run;
using test::set_mode;
using test::unhurried;
using test::with_everything;

constexpr double hour_s = 3600.0;

// Power on.

TEST(Device, WarmsUpThenIsIdle) {
  Device device = device_of(with_everything());
  EXPECT_EQ(device.status().state, DeviceState::warm_up);
  EXPECT_EQ(device.status().cover, PortCover::nothing);
  EXPECT_TRUE(device.status().is_calibration_due);
  EXPECT_EQ(device.since_calibration_s(), std::numeric_limits<double>::infinity());
  device.advance(29.999999999);
  EXPECT_EQ(device.status().state, DeviceState::warm_up);
  device.advance(1e-9);
  EXPECT_EQ(device.status().state, DeviceState::idle);
  EXPECT_EQ(device.uptime_s(), 30.0);
}

TEST(Device, ThatNeedsNoWarmUpIsIdleAtOnce) {
  EXPECT_EQ(device_of(unhurried()).status().state, DeviceState::idle);
}

TEST(Device, SaysThatItWasSwitchedOn) {
  EXPECT_TRUE(has_alarm(device_of(unhurried()), Alarm::restarted));
}

TEST(Device, BeginsWithTheSettingsOfTheFactory) {
  std::vector<Channel> channels = test::three_channels();
  channels[1].tile_assigned_gu = 93.6;
  const Device device(Identity{}, unhurried(), channels, {});
  EXPECT_EQ(device.settings(), device.factory_settings());
  EXPECT_EQ(device.settings().channels.at(1).tile_gu, 93.6);
  EXPECT_EQ(device.settings().channels.at(2).tile_gu, 100.0);
}

TEST(Device, KnowsItsTemperature) {
  Device device = device_of(with_everything());
  device.advance(600.0);
  EXPECT_EQ(device.temperature_c(), temperature_c(device.behaviour(), 600.0));
  EXPECT_GT(device.temperature_c(), 26.0);
}

TEST(Device, RefusesTimeThatDoesNotPass) {
  Device device = device_of(unhurried());
  for (const double seconds : {-1e-9, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 4e9}) {
    EXPECT_THROW(device.advance(seconds), std::domain_error) << seconds;
  }
  device.advance(3e9);
  EXPECT_THROW(device.advance(3e9), std::domain_error);
  EXPECT_EQ(device.uptime_s(), 3e9);
}

// The same in one step as in many.

struct Act {
  double at_s;
  std::function<void(Device&)> act;
};

/// A shift with everything that can happen in it. Refused commands are part of it.
std::vector<Act> shift() {
  const auto give = [](DeviceCommand command) {
    return [command](Device& device) { (void)device.command(command); };
  };
  const auto lay = [](PortCover cover, int sample) {
    return [=](Device& device) { device.place(cover, sample); };
  };
  const auto mode = [](MeasuringMode value) {
    return [value](Device& device) { set_mode(device, value); };
  };
  return {{10.0, give(DeviceCommand::measure)},
          {31.0, lay(PortCover::black_trap, 0)},
          {31.0, give(DeviceCommand::zero)},
          {34.7, lay(PortCover::tile, 0)},
          {34.7, give(DeviceCommand::calibrate)},
          {38.123456789, lay(PortCover::sample, test::paint)},
          {38.2, give(DeviceCommand::measure)},
          {39.0, give(DeviceCommand::store_reference)},
          {39.0, mode(MeasuringMode::difference)},
          {39.1, give(DeviceCommand::measure)},
          {40.0, mode(MeasuringMode::statistics)},
          {40.0, give(DeviceCommand::measure)},
          {41.0, lay(PortCover::sample, test::matt)},
          {44.0, mode(MeasuringMode::continuous)},
          {44.0, give(DeviceCommand::measure)},
          {60.0, give(DeviceCommand::acknowledge_alarms)},
          {100.0, lay(PortCover::sample, test::mirror)},
          {130.0, give(DeviceCommand::stop)},
          {131.0, mode(MeasuringMode::pass_fail)},
          {131.0, give(DeviceCommand::measure)},
          {131.2, give(DeviceCommand::stop)},
          {140.0, give(DeviceCommand::measure)},
          {200.0, [](Device& device) { device.set_fault(InstrumentFault::lamp_failure, false); }},
          {201.0, give(DeviceCommand::measure)},
          {300.0, give(DeviceCommand::restart)}};
}

std::string story(const std::function<double(double)>& step_s) {
  Behaviour behaviour = with_everything();
  behaviour.calibration_interval_s = 55.0;
  behaviour.faults = {{InstrumentFault::lamp_failure, 140.3},
                      {InstrumentFault::drift_step, 50.0, 0.02},
                      {InstrumentFault::frozen_reading, 110.0}};
  Device device = device_of(behaviour);
  std::string text;
  double passed_s = 0.0;
  const auto advance_to = [&](double at_s) {
    while (device.uptime_s() < at_s - passed_s) {
      const double left_s = at_s - passed_s - device.uptime_s();
      device.advance(std::min(left_s, step_s(left_s)));
    }
  };
  for (const Act& act : shift()) {
    advance_to(act.at_s);
    text += description(device);
    act.act(device);
    text += description(device);
  }
  passed_s = 300.0;
  advance_to(400.0);
  return text + description(device);
}

// Seeds 1 to 5; steps from a nanosecond to three seconds.
TEST(Device, DoesTheSameInOneStepAsInMany) {
  const std::string expected = story([](double left_s) { return left_s; });
  EXPECT_EQ(story([](double) { return 0.1; }), expected);
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-9.0, 0.5);
    EXPECT_EQ(story([&](double) { return std::max(1e-9, std::pow(10.0, exponent(random))); }),
              expected)
        << "seed " << seed;
  }
}

TEST(Device, TakesASmallStepForWhatItIs) {
  Device device = device_of(unhurried());
  for (int i = 0; i < 10; ++i) {
    device.advance(0.1);
  }
  EXPECT_EQ(device.uptime_s(), 1.0);
}

TEST(Device, GivesTheSameReadingsForTheSameSeedAndOthersForAnother) {
  const auto reading = [](std::uint64_t seed) {
    Behaviour behaviour = unhurried();
    behaviour.repeatability_gu = 0.05;
    behaviour.seed = seed;
    Device device = device_of(behaviour);
    (void)calibrate(device);
    (void)measure(device, test::paint);
    return reading_gu(device, 1);
  };
  EXPECT_EQ(reading(1), reading(1));
  EXPECT_NE(reading(1), reading(2));
}

// Drift.

TEST(Device, LosesLightOverAShiftAndRegainsItByACalibration) {
  Behaviour behaviour = unhurried();
  behaviour.drift_per_h = 0.0002;
  behaviour.drift_limit = 0.004;
  Device device = device_of(behaviour);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  const double fresh = lamp_factor(behaviour, 3.0);
  device.advance(8 * hour_s);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  const double tired = lamp_factor(behaviour, device.uptime_s());
  // The lamp loses 1e-10 of its light in the three seconds of a calibration.
  constexpr double during_calibration_gu = 1e-4;
  EXPECT_TRUE(
      is_close(reading_gu(device, 1), test::paint_gu[1] * tired / fresh, during_calibration_gu));
  EXPECT_GT(test::paint_gu[1] - reading_gu(device, 1), 0.1);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  EXPECT_TRUE(is_close(device.status().channels[1].calibration_deviation_gu, 100.0 * (tired - 1.0),
                       during_calibration_gu));
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  EXPECT_TRUE(is_close(reading_gu(device, 1), test::paint_gu[1], during_calibration_gu));
}

TEST(Device, WantsACalibrationAgainAfterItsInterval) {
  Device device = device_of(unhurried());
  device.advance(24 * hour_s);
  EXPECT_TRUE(device.status().is_calibration_due);
  EXPECT_FALSE(has_alarm(device, Alarm::calibration_overdue));  // none was done, none is overdue
  ASSERT_EQ(calibrate(device), DeviceError::none);
  EXPECT_FALSE(device.status().is_calibration_due);
  device.advance(8 * hour_s - 1.0);
  EXPECT_FALSE(device.status().is_calibration_due);
  EXPECT_FALSE(has_alarm(device, Alarm::calibration_overdue));
  device.advance(1.0);
  EXPECT_TRUE(device.status().is_calibration_due);
  EXPECT_TRUE(has_alarm(device, Alarm::calibration_overdue));
  EXPECT_EQ(measure(device, test::paint), DeviceError::none);  // it warns, it does not refuse
  EXPECT_GE(device.since_calibration_s(), 8 * hour_s);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  EXPECT_FALSE(device.status().is_calibration_due);
  EXPECT_LT(device.since_calibration_s(), 1.0);
}

// Faults.

TEST(DeviceFault, BeginsAfterItsTime) {
  Behaviour behaviour = unhurried();
  behaviour.faults = {{InstrumentFault::drift_step, hour_s, 0.02},
                      {InstrumentFault::over_range, 60.0}};  // in any order
  Device device = device_of(behaviour);
  device.advance(59.0);
  EXPECT_EQ(device.status().faults, 0U);
  device.advance(1.0);
  EXPECT_EQ(device.status().faults, 1U << unsigned(InstrumentFault::over_range));
  device.advance(hour_s);
  EXPECT_EQ(device.status().faults, 1U << unsigned(InstrumentFault::over_range) |
                                        1U << unsigned(InstrumentFault::drift_step));
}

TEST(DeviceFault, OfTheLampInterruptsAMeasurement) {
  Device device = device_of(unhurried());
  ASSERT_EQ(calibrate(device), DeviceError::none);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  device.advance(0.1);
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  EXPECT_EQ(device.status().state, DeviceState::fault);
  EXPECT_EQ(device.status().command.state, CommandState::failed);
  EXPECT_EQ(device.status().command.error, DeviceError::lamp_failure);
  EXPECT_TRUE(has_alarm(device, Alarm::lamp_failure));
  device.advance(10.0);
  EXPECT_EQ(device.status().sequence, 0U);
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, false));
  EXPECT_EQ(device.status().state, DeviceState::idle);
  EXPECT_TRUE(has_alarm(device, Alarm::lamp_failure));  // until it is acknowledged
}

TEST(DeviceFault, OfTheLampInterruptsACalibrationAndTheOldOneStays) {
  Device device = device_of(unhurried());
  ASSERT_EQ(calibrate(device), DeviceError::none);
  ASSERT_TRUE(device.command(DeviceCommand::calibrate));
  device.advance(1.0);
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  EXPECT_EQ(device.status().command.error, DeviceError::lamp_failure);
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, false));
  EXPECT_EQ(measure(device, test::paint), DeviceError::none);
}

TEST(DeviceFault, OfTheLampWhileItWarmsUpLeadsBackThere) {
  Device device = device_of(with_everything());
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, true));
  EXPECT_EQ(device.status().state, DeviceState::fault);
  EXPECT_TRUE(device.set_fault(InstrumentFault::lamp_failure, false));
  EXPECT_EQ(device.status().state, DeviceState::warm_up);
}

TEST(DeviceFault, FrozenReadingCountsOnAndStandsStill) {
  Behaviour behaviour = unhurried();
  behaviour.repeatability_gu = 0.05;
  Device device = device_of(behaviour);
  ASSERT_EQ(calibrate(device), DeviceError::none);
  ASSERT_EQ(measure(device, test::paint), DeviceError::none);
  const double last = reading_gu(device, 1);
  EXPECT_TRUE(device.set_fault(InstrumentFault::frozen_reading, true));
  ASSERT_EQ(measure(device, test::matt), DeviceError::none);
  EXPECT_EQ(reading_gu(device, 1), last);
  EXPECT_EQ(device.status().sequence, 2U);
}

TEST(DeviceFault, WithAMagnitudeOutOfItsRangeChangesNothing) {
  Device device = device_of(unhurried());
  const auto revision = device.revision();
  EXPECT_FALSE(device.set_fault(InstrumentFault::tile_dirty, true, 2.0));
  EXPECT_EQ(device.status().faults, 0U);
  EXPECT_EQ(device.revision(), revision);
}

// The port.

TEST(Device, ShowsWhatLiesOnItsPort) {
  Device device = device_of(unhurried());
  device.place(PortCover::sample, test::mirror);
  EXPECT_EQ(device.status().cover, PortCover::sample);
  EXPECT_EQ(device.status().sample, test::mirror);
  device.place(PortCover::tile);
  EXPECT_EQ(device.status().cover, PortCover::tile);
  EXPECT_EQ(device.status().sample, 0);
  EXPECT_THROW(device.place(PortCover::sample, 3), std::out_of_range);
  EXPECT_EQ(device.status().cover, PortCover::tile);
}

// Revision.

TEST(Device, HasANewRevisionWithEveryChangeAndNoneWithoutOne) {
  Device device = device_of(unhurried());
  auto last = device.revision();
  const auto expect_new = [&](const char* what) {
    EXPECT_GT(device.revision(), last) << what;
    last = device.revision();
  };
  device.advance(10.0);
  EXPECT_EQ(device.revision(), last);
  device.place(PortCover::tile);
  expect_new("place");
  (void)device.command(DeviceCommand::calibrate);
  expect_new("command");
  EXPECT_FALSE(device.command(DeviceCommand::measure));
  EXPECT_EQ(device.revision(), last) << "busy";
  device.advance(3.0);
  expect_new("end of calibration");
  (void)device.set(device.settings());
  expect_new("settings");
  (void)device.set_fault(InstrumentFault::over_range, true);
  expect_new("fault");
  device.keep_settings({}, std::nullopt);
  expect_new("keep_settings");
  device.advance(8 * hour_s);
  expect_new("overdue");
}

// Settings.

TEST(DeviceSettings, AreSetAllOrNone) {
  Device device = device_of(unhurried());
  const DeviceSettings before = device.settings();
  const auto revision = device.revision();
  DeviceSettings settings = before;
  settings.mode = MeasuringMode::continuous;
  settings.interval_s = 0.05;
  EXPECT_EQ(device.set(settings), "interval_s");
  EXPECT_EQ(device.settings(), before);
  EXPECT_EQ(device.revision(), revision);
  settings.interval_s = 0.1;
  EXPECT_EQ(device.set(settings), std::nullopt);
  EXPECT_EQ(device.settings(), settings);
}

TEST(DeviceSettings, OfWhatRunsAreThoseItBeganWith) {
  Device device = device_of(unhurried());
  ASSERT_EQ(calibrate(device), DeviceError::none);
  set_mode(device, MeasuringMode::statistics);
  ASSERT_TRUE(device.command(DeviceCommand::measure));
  device.advance(0.6);
  set_mode(device, MeasuringMode::single);
  device.advance(1.9);
  EXPECT_EQ(device.status().command.state, CommandState::done);
  EXPECT_EQ(device.status().channels[0].statistics.n, 5);
}

TEST(DeviceSettings, ThatWereKeptAreInForceAtOnceAndAfterARestart) {
  Device device = device_of(unhurried());
  DeviceSettings kept = device.settings();
  kept.statistics_readings = 7;
  device.keep_settings({}, kept);
  EXPECT_EQ(device.settings(), kept);
  set_mode(device, MeasuringMode::continuous);
  EXPECT_EQ(run(device, DeviceCommand::restart), DeviceError::none);
  EXPECT_EQ(device.settings(), kept);
}

TEST(DeviceSettings, ThatWereKeptForAnotherInstrumentAreRefused) {
  Device device = device_of(unhurried());
  DeviceSettings kept = device.settings();
  kept.channels.pop_back();
  EXPECT_EQ(message_of([&] { device.keep_settings({}, kept); }),
            "Device::keep_settings: channels is out of its range");
  EXPECT_EQ(device.settings(), device.factory_settings());
}

}  // namespace
}  // namespace gonio

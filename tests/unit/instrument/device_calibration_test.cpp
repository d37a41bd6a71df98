// Calibration on the tile, and zero on the black trap.
#include <gtest/gtest.h>

#include <optional>

#include "emulator/instrument/device.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"

namespace gonio {
namespace {

using test::calibrate;
using test::calibrated;
using test::device_of;
using test::has_alarm;
using test::is_close;
using test::measure;
using test::reading_gu;
using test::run;
using test::unhurried;
using test::zero;

constexpr double rounding = 1e-12;

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

}  // namespace
}  // namespace gonio

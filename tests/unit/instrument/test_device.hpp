#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "emulator/instrument/device.hpp"

namespace gonio::test {

// Numbers that are no round binary fractions, so that an operation too many shows in the last bit.
inline constexpr int matt = 0, paint = 1, mirror = 2;
inline const std::vector<double> matt_gu{0.1434930766626433, 1.5008088867276577,
                                         0.8946121694323435};
inline const std::vector<double> paint_gu{43.387389959118565, 83.38410071616812, 90.87295944868612};
inline const std::vector<double> mirror_gu{2037.6018812275238, 997.2754174434049,
                                           162.21084635079131};

inline std::vector<Channel> three_channels() {
  return {{.geometry_id = "20", .theta_i = degrees(20)},
          {.geometry_id = "60", .theta_i = degrees(60)},
          {.geometry_id = "85", .theta_i = degrees(85)}};
}

inline std::vector<DeviceSample> three_samples() {
  return {{"matt", "Matt", matt_gu}, {"paint", "Paint", paint_gu}, {"mirror", "Mirror", mirror_gu}};
}

/// Ideal, but it takes its time and insists on being calibrated.
inline Behaviour unhurried() {
  Behaviour behaviour = Behaviour().ideal();
  behaviour.reading_s = 0.5;
  behaviour.calibration_s = 3.0;
  behaviour.calibration_required = true;
  return behaviour;
}

/// With every deviation that there is.
inline Behaviour with_everything() {
  Behaviour behaviour;
  behaviour.warm_up_loss = 0.02;
  behaviour.repeatability_gu = 0.05;
  behaviour.resolution_gu = 0.1;
  behaviour.linearity = 0.0005;
  behaviour.stray_light_gu = 0.1;
  behaviour.ambient_light_gu = 0.3;
  behaviour.drift_per_h = 0.0002;
  behaviour.drift_limit = 0.004;
  behaviour.self_heating_k = 6.0;
  behaviour.signal_per_k = -0.0003;
  behaviour.full_scale_gu = {2000.0, 1000.0, 160.0};
  return behaviour;
}

inline Device device_of(Behaviour behaviour) {
  return {Identity{}, std::move(behaviour), three_channels(), three_samples()};
}

/// Gives a command that takes no more than a minute, and waits for its end.
/// @return  what became of it.
inline DeviceError run(Device& device, DeviceCommand command) {
  if (!device.command(command)) {
    return DeviceError::busy;
  }
  for (int i = 0; i < 600 && device.status().command.state == CommandState::running; ++i) {
    device.advance(0.1);
  }
  return device.status().command.error;
}

inline DeviceError calibrate(Device& device) {
  device.place(PortCover::tile);
  return run(device, DeviceCommand::calibrate);
}
inline DeviceError zero(Device& device) {
  device.place(PortCover::black_trap);
  return run(device, DeviceCommand::zero);
}
inline DeviceError measure(Device& device, int sample) {
  device.place(PortCover::sample, sample);
  return run(device, DeviceCommand::measure);
}

/// @return  NaN unless the reading is valid.
inline double reading_gu(const Device& device, std::size_t channel) {
  const ChannelValue& reading = device.status().channels.at(channel).reading;
  return reading.status == ReadingStatus::valid ? reading.gloss_gu : std::nan("");
}

inline bool has_alarm(const Device& device, Alarm alarm) {
  return (device.status().alarms >> unsigned(alarm) & 1U) != 0;
}

inline void set_mode(Device& device, MeasuringMode mode) {
  DeviceSettings settings = device.settings();
  settings.mode = mode;
  EXPECT_EQ(device.set(settings), std::nullopt);
}

/// All that is visible, to the last bit.
inline std::string description(const Device& device) {
  const Device::Status& s = device.status();
  std::string text = fmt::format(
      "state {} cover {} sample {} alarms {} sequence {} command {} {} {} {} due {} reference {} "
      "left {} faults {} uptime {} temperature {} since {}\n",
      int(s.state), int(s.cover), s.sample, s.alarms, s.sequence, int(s.command.command),
      int(s.command.state), int(s.command.error), s.command.sequence, s.is_calibration_due,
      s.is_reference_set, s.readings_left, s.faults, device.uptime_s(), device.temperature_c(),
      device.since_calibration_s());
  for (const ChannelStatus& c : s.channels) {
    text += fmt::format(
        "  {} {} n {} mean {} s {} min {} max {} difference {} {} verdict {} {} {} {}\n",
        int(c.reading.status), c.reading.gloss_gu, c.statistics.n, c.statistics.mean,
        c.statistics.standard_deviation, c.statistics.minimum, c.statistics.maximum,
        int(c.difference.status), c.difference.gloss_gu, int(c.verdict), c.is_calibrated,
        c.calibration_deviation_gu, c.zero_offset_gu);
  }
  return text;
}

/// On its tile, and calibrated.
inline Device calibrated(const Behaviour& behaviour = unhurried()) {
  Device device = device_of(behaviour);
  EXPECT_EQ(calibrate(device), DeviceError::none);
  return device;
}

/// Mode `statistics` with n readings.
inline void set_readings(Device& device, int n) {
  DeviceSettings settings = device.settings();
  settings.mode = MeasuringMode::statistics;
  settings.statistics_readings = n;
  EXPECT_EQ(device.set(settings), std::nullopt);
}

}  // namespace gonio::test

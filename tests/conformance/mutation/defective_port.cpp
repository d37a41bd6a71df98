#include "tests/conformance/mutation/defective_port.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gonio::conformance {

namespace {

/// Passes everything on.
class ForwardingPort : public DevicePort {
 public:
  explicit ForwardingPort(std::shared_ptr<DevicePort> sound) : sound_(std::move(sound)) {}

  [[nodiscard]] const Identity& identity() const override { return sound_->identity(); }
  [[nodiscard]] std::string where() const override { return sound_->where(); }
  [[nodiscard]] const std::vector<PortChannel>& channels() const override {
    return sound_->channels();
  }
  [[nodiscard]] std::optional<StatedAngle> setup(std::size_t channel,
                                                 SetupQuantity quantity) override {
    return sound_->setup(channel, quantity);
  }
  void place(PortCover cover, const std::string& sample) override { sound_->place(cover, sample); }
  [[nodiscard]] DeviceError command(DeviceCommand command) override {
    return sound_->command(command);
  }
  [[nodiscard]] PortStatus status() override { return sound_->status(); }
  void pass(double seconds) override { sound_->pass(seconds); }

 private:
  std::shared_ptr<DevicePort> sound_;
};

/// Shows something else than it has found.
template <void (*change)(PortStatus&)>
std::shared_ptr<DevicePort> showing(std::shared_ptr<DevicePort> sound) {
  class Port final : public ForwardingPort {
   public:
    using ForwardingPort::ForwardingPort;
    [[nodiscard]] PortStatus status() override {
      PortStatus status = ForwardingPort::status();
      change(status);
      return status;
    }
  };
  return std::make_shared<Port>(std::move(sound));
}

/// Shows another number for each valid reading.
template <double (*change)(double)>
void change_readings(PortStatus& status) {
  for (ChannelValue& reading : status.readings) {
    if (reading.status == ReadingStatus::valid) {
      reading.gloss_gu = change(reading.gloss_gu);
    }
  }
}

double scaled(double gloss_gu) { return 1.02 * gloss_gu; }
double cut_to_whole_units(double gloss_gu) { return std::trunc(gloss_gu); }
double in_three_digits(double gloss_gu) { return std::fmod(gloss_gu, 1000.0); }
double in_16_bits(double gloss_gu) { return std::fmod(gloss_gu, 655.36); }
double clipped(double gloss_gu) { return std::min(gloss_gu, 200.0); }

void call_over_range(PortStatus& status) {
  for (ChannelValue& reading : status.readings) {
    if (reading.gloss_gu > 1000.0) {
      reading = {.status = ReadingStatus::over_range};
    }
  }
}

void exchange_channels(PortStatus& status) {
  std::swap(status.readings.front(), status.readings.back());
}

void show_first_channel(PortStatus& status) {
  std::fill(status.readings.begin(), status.readings.end(), status.readings.front());
}

void never_ready(PortStatus& status) { status.state = DeviceState::warm_up; }
void always_ready(PortStatus& status) { status.state = DeviceState::idle; }
void never_due(PortStatus& status) { status.is_calibration_due = false; }

/// A minimum that begins at 0 is never reached by a gloss.
void minimum_from_zero(PortStatus& status) {
  for (ChannelStatistics& statistics : status.statistics) {
    statistics.minimum = 0.0;
  }
}

void count_one_more(PortStatus& status) {
  for (ChannelStatistics& statistics : status.statistics) {
    ++statistics.n;
  }
}

void mean_of_extremes(PortStatus& status) {
  for (ChannelStatistics& statistics : status.statistics) {
    statistics.mean = 0.5 * (statistics.minimum + statistics.maximum);
  }
}

void divide_by_n(PortStatus& status) {
  for (ChannelStatistics& statistics : status.statistics) {
    if (statistics.n > 1) {
      statistics.standard_deviation *= std::sqrt(double(statistics.n - 1) / statistics.n);
    }
  }
}

/// Says that a command is done, and does nothing.
template <DeviceCommand ignored>
std::shared_ptr<DevicePort> ignoring(std::shared_ptr<DevicePort> sound) {
  class Port final : public ForwardingPort {
   public:
    using ForwardingPort::ForwardingPort;
    [[nodiscard]] DeviceError command(DeviceCommand command) override {
      return command == ignored ? DeviceError::none : ForwardingPort::command(command);
    }
  };
  return std::make_shared<Port>(std::move(sound));
}

/// Does not say why it does nothing.
template <DeviceError kept>
std::shared_ptr<DevicePort> keeping_quiet(std::shared_ptr<DevicePort> sound) {
  class Port final : public ForwardingPort {
   public:
    using ForwardingPort::ForwardingPort;
    [[nodiscard]] DeviceError command(DeviceCommand command) override {
      const DeviceError error = ForwardingPort::command(command);
      return error == kept ? DeviceError::none : error;
    }
  };
  return std::make_shared<Port>(std::move(sound));
}

/// Shows the reading before the last one, where there is one.
class StalePort final : public ForwardingPort {
 public:
  using ForwardingPort::ForwardingPort;
  [[nodiscard]] DeviceError command(DeviceCommand command) override {
    std::vector<ChannelValue> before = ForwardingPort::status().readings;
    const DeviceError error = ForwardingPort::command(command);
    if (command == DeviceCommand::measure && error == DeviceError::none) {
      shown_ = before.front().status == ReadingStatus::not_measured
                   ? ForwardingPort::status().readings
                   : std::move(before);
    }
    return error;
  }
  [[nodiscard]] PortStatus status() override {
    PortStatus status = ForwardingPort::status();
    if (!shown_.empty()) {
      status.readings = shown_;
    }
    return status;
  }

 private:
  std::vector<ChannelValue> shown_ = {};
};

std::shared_ptr<DevicePort> stale(std::shared_ptr<DevicePort> sound) {
  return std::make_shared<StalePort>(std::move(sound));
}

}  // namespace

const std::map<std::string, PortDefect>& port_defects() {
  static const std::map<std::string, PortDefect> all{
      {"scaled", showing<change_readings<scaled>>},
      {"cut_to_whole_units", showing<change_readings<cut_to_whole_units>>},
      {"in_three_digits", showing<change_readings<in_three_digits>>},
      {"in_16_bits", showing<change_readings<in_16_bits>>},
      {"clipped", showing<change_readings<clipped>>},
      {"over_range_too_early", showing<call_over_range>},
      {"channels_exchanged", showing<exchange_channels>},
      {"first_channel_only", showing<show_first_channel>},
      {"never_ready", showing<never_ready>},
      {"always_ready", showing<always_ready>},
      {"calibration_never_due", showing<never_due>},
      {"minimum_from_zero", showing<minimum_from_zero>},
      {"count_one_more", showing<count_one_more>},
      {"mean_of_extremes", showing<mean_of_extremes>},
      {"deviation_over_n", showing<divide_by_n>},
      {"stale_reading", stale},
      {"zero_ignored", ignoring<DeviceCommand::zero>},
      {"calibration_ignored", ignoring<DeviceCommand::calibrate>},
      {"clearing_ignored", ignoring<DeviceCommand::clear_statistics>},
      {"quiet_in_warm_up", keeping_quiet<DeviceError::warming_up>},
      {"quiet_uncalibrated", keeping_quiet<DeviceError::not_calibrated>}};
  return all;
}

}  // namespace gonio::conformance

#include "emulator/protocol/instrument_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/protocol/value_readers.hpp"

namespace gonio {

using namespace value_readers;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double over_range = std::numeric_limits<double>::infinity();

double low_bits(double value, double modulus) { return std::fmod(std::floor(value), modulus); }

double gloss_of(const ChannelValue& value) {
  return value.status == ReadingStatus::valid        ? value.gloss_gu
         : value.status == ReadingStatus::over_range ? over_range
                                                     : none;
}

bool is_busy(const View& view) {
  return status(view).state == DeviceState::measuring ||
         status(view).state == DeviceState::calibrating;
}

bool is_running(const View& view, DeviceCommand command) {
  return status(view).command.command == command &&
         status(view).command.state == CommandState::running;
}

/// Counts the measured channels whose last reading has that status.
std::size_t readings_with(const View& view, ReadingStatus wanted) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < status(view).channels.size(); ++i) {
    n += view.device.settings().channels[i].is_measured &&
                 status(view).channels[i].reading.status == wanted
             ? 1U
             : 0U;
  }
  return n;
}

bool is_result_valid(const View& view) {
  const std::size_t valid = readings_with(view, ReadingStatus::valid);
  return valid > 0 && readings_with(view, ReadingStatus::over_range) == 0 &&
         readings_with(view, ReadingStatus::not_measured) == 0;
}

bool has_fault(const View& view, InstrumentFault fault) {
  return (status(view).faults >> static_cast<unsigned>(fault) & 1U) != 0;
}

/// A value of each channel.
template <class Read>
InstrumentValue each(Read read) {
  return {.number = [read](const View& view, std::size_t channel) {
    return double(read(status(view).channels[channel]));
  }};
}

template <class Read>
InstrumentValue each_setting(Read read) {
  return {.number = [read](const View& view, std::size_t channel) {
    return double(read(view.device.settings().channels[channel]));
  }};
}

template <class Read>
InstrumentValue each_built(Read read) {
  return {.number = [read](const View& view, std::size_t channel) {
    return double(read(view.device.channels()[channel]));
  }};
}

template <class Read>
InstrumentValue statistic(Read read) {
  return each([read](const ChannelStatus& channel) {
    return channel.statistics.n > 0 ? read(channel.statistics) : none;
  });
}

void add_status_bits(Values& values) {
  const auto bit = [&](const char* name, auto read) { values.emplace(name, whole(read)); };
  bit("ready", [](const View& v) {
    return status(v).state == DeviceState::idle && (!v.device.behaviour().calibration_required ||
                                                    std::isfinite(v.device.since_calibration_s()));
  });
  bit("busy", is_busy);
  bit("measuring", [](const View& v) { return status(v).state == DeviceState::measuring; });
  bit("calibrating", [](const View& v) { return status(v).state == DeviceState::calibrating; });
  bit("result_valid", is_result_valid);
  bit("calibration_due", [](const View& v) { return status(v).is_calibration_due; });
  bit("on_standard", [](const View& v) { return status(v).cover == PortCover::tile; });
  bit("warming_up", [](const View& v) { return status(v).state == DeviceState::warm_up; });
  bit("lamp_failed", [](const View& v) { return has_fault(v, InstrumentFault::lamp_failure); });
  bit("over_range", [](const View& v) { return readings_with(v, ReadingStatus::over_range) > 0; });
  bit("alarm", [](const View& v) { return status(v).alarms != 0; });
  bit("command_failed",
      [](const View& v) { return status(v).command.state == CommandState::failed; });
  bit("reference_set", [](const View& v) { return status(v).is_reference_set; });
  bit("settings_locked", [](const View& v) { return v.state.are_settings_locked; });
  bit("simulated", [](const View& v) { return v.is_simulated; });
}

void add_alarm_bits(Values& values) {
  const auto bit = [&](const char* name, Alarm alarm) {
    values.emplace(name, whole([alarm](const View& view) {
                     return status(view).alarms >> static_cast<unsigned>(alarm) & 1U;
                   }));
  };
  bit("alarm_restarted", Alarm::restarted);
  bit("alarm_lamp_failure", Alarm::lamp_failure);
  bit("alarm_tile_refused", Alarm::tile_refused);
  bit("alarm_zero_refused", Alarm::zero_refused);
  bit("alarm_over_range", Alarm::over_range);
  bit("alarm_calibration_overdue", Alarm::calibration_overdue);
  bit("alarm_storage_failed", Alarm::storage_failed);
}

void add_status(Values& values) {
  const auto add = [&](const char* name, auto read) { values.emplace(name, whole(read)); };
  add("state", [](const View& v) { return number_of(status(v).state); });
  add("mode", [](const View& v) { return number_of(v.device.settings().mode); });
  add("alarms", [](const View& v) { return status(v).alarms; });
  add("sequence", [](const View& v) { return status(v).sequence; });
  add("sequence_low", [](const View& v) { return status(v).sequence & 0xFFFFU; });
  add("command_sequence", [](const View& v) { return status(v).command.sequence; });
  add("last_command", [](const View& v) { return number_of(status(v).command.command); });
  add("command_state", [](const View& v) { return number_of(status(v).command.state); });
  add("command_error", [](const View& v) { return number_of(status(v).command.error); });
  add("heartbeat", [](const View& v) { return low_bits(v.device.uptime_s(), 0x1p16); });
  add("uptime", [](const View& v) { return low_bits(v.device.uptime_s(), 0x1p32); });
  add("temperature", [](const View& v) { return v.device.temperature_c(); });
  add("readings_left", [](const View& v) { return status(v).readings_left; });
  add("channel_count", [](const View& v) { return v.device.channels().size(); });
  add("calibration_age", [](const View& v) { return std::floor(v.device.since_calibration_s()); });
  add("calibration_interval",
      [](const View& v) { return v.device.behaviour().calibration_interval_s; });
}

void add_channel_values(Values& values) {
  const auto add = [&](const char* name, auto read) { values.emplace(name, each(read)); };
  add("gloss", [](const ChannelStatus& c) { return gloss_of(c.reading); });
  add("reading_state", [](const ChannelStatus& c) { return number_of(c.reading.status); });
  add("difference", [](const ChannelStatus& c) { return gloss_of(c.difference); });
  add("verdict", [](const ChannelStatus& c) { return number_of(c.verdict); });
  add("statistics_n", [](const ChannelStatus& c) { return c.statistics.n; });
  add("is_calibrated", [](const ChannelStatus& c) { return c.is_calibrated; });
  add("calibration_deviation", [](const ChannelStatus& c) { return c.calibration_deviation_gu; });
  add("zero_offset", [](const ChannelStatus& c) { return c.zero_offset_gu; });
  const auto add_statistic = [&](const char* name, auto read) {
    values.emplace(name, statistic(read));
  };
  using Statistics = ChannelStatistics;
  add_statistic("mean", [](const Statistics& s) { return s.mean; });
  add_statistic("standard_deviation",
                [](const Statistics& s) { return s.n > 1 ? s.standard_deviation : none; });
  add_statistic("minimum", [](const Statistics& s) { return s.minimum; });
  add_statistic("maximum", [](const Statistics& s) { return s.maximum; });
  add_statistic("range", [](const Statistics& s) { return s.range(); });
  values.emplace("angle", each_built([](const Channel& c) { return c.theta_i.degrees(); }));
  values.emplace("tile_certified", each_built([](const Channel& c) { return c.tile_assigned_gu; }));
  values.emplace("full_scale", InstrumentValue{.number = [](const View& view, std::size_t channel) {
                   const std::vector<double>& limits = view.device.behaviour().full_scale_gu;
                   return channel < limits.size() ? limits[channel] : none;
                 }});
}

/// As the maker states it, with its expanded uncertainty.
void add_setup(Values& values) {
  for (std::size_t quantity = 0; quantity < setup_quantity_count; ++quantity) {
    const auto add = [&](const std::string& name, Angle StatedAngle::*part) {
      values.emplace(name, each_built([quantity, part](const Channel& channel) {
                       const std::optional<StatedAngle>& stated = channel.setup.at(quantity);
                       return stated ? ((*stated).*part).degrees() : none;
                     }));
    };
    const std::string name = setup_quantity_names.at(quantity);
    add(name, &StatedAngle::value);
    add(name + "_uncertainty", &StatedAngle::expanded_uncertainty);
  }
}

void add_settings(Values& values) {
  const auto add = [&](const char* name, auto read) { values.emplace(name, whole(read)); };
  add("command", [](const View& v) {
    const CommandOutcome& command = status(v).command;
    return command.state == CommandState::running ? number_of(command.command) : 0.0;
  });
  add("settings_lock", [](const View& v) { return v.state.are_settings_locked; });
  add("statistics_readings", [](const View& v) { return v.device.settings().statistics_readings; });
  add("interval", [](const View& v) { return v.device.settings().interval_s; });
  add("has_reference", [](const View& v) { return v.device.settings().has_reference; });
  add("measured_channels", [](const View& v) {
    unsigned mask = 0;
    for (std::size_t i = 0; i < v.device.settings().channels.size(); ++i) {
      mask |= v.device.settings().channels[i].is_measured ? 1U << i : 0U;
    }
    return mask;
  });
  using Setting = DeviceSettings::ByChannel;
  values.emplace("reference", each_setting([](const Setting& s) { return s.reference_gu; }));
  values.emplace("lower_limit", each_setting([](const Setting& s) { return s.lower_limit_gu; }));
  values.emplace("upper_limit", each_setting([](const Setting& s) { return s.upper_limit_gu; }));
  values.emplace("tile", each_setting([](const Setting& s) { return s.tile_gu; }));
}

void add_commands(Values& values) {
  const auto add = [&](const char* name, DeviceCommand command) {
    values.emplace(name, whole([command](const View& v) { return is_running(v, command); }));
  };
  add("run_measure", DeviceCommand::measure);
  add("run_calibrate", DeviceCommand::calibrate);
  add("run_zero", DeviceCommand::zero);
  add("run_stop", DeviceCommand::stop);
  add("run_acknowledge_alarms", DeviceCommand::acknowledge_alarms);
}

}  // namespace

int present_sample(const Device& device, const UnitState& state) {
  return device.status().cover == PortCover::sample ? device.status().sample : state.sample;
}

const std::map<std::string, InstrumentValue>& instrument_values() {
  static const Values values = [] {
    Values all;
    for (const auto add : {add_status_bits, add_alarm_bits, add_status, add_channel_values,
                           add_setup, add_settings, add_commands, add_server_values}) {
      add(all);
    }
    return all;
  }();
  return values;
}

}  // namespace gonio

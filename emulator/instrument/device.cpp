#include "emulator/instrument/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "emulator/instrument/signal.hpp"

namespace gonio {

Device::Device(Identity identity, Behaviour behaviour, std::vector<Channel> channels,
               std::vector<DeviceSample> samples)
    : identity_(std::move(identity)),
      head_(std::move(behaviour), std::move(channels), std::move(samples)) {
  power_on();
}

void Device::power_on() {
  uptime_ = {};
  next_fault_ = 0;
  activity_.reset();
  calibrated_at_.reset();
  is_overdue_ = false;
  head_.reset();
  settings_ = saved_.value_or(factory_settings());
  status_ = {.cover = head_.cover(),
             .sample = head_.sample(),
             .command = status_.command,
             .faults = status_.faults};
  status_.channels.resize(channels().size());
  clear_statistics();
  raise(Alarm::restarted);
  run_until(uptime_);
  changed();
}

DeviceSettings Device::factory_settings() const {
  DeviceSettings settings;
  for (const Channel& channel : channels()) {
    settings.channels.push_back({.tile_gu = channel.tile_assigned_gu});
  }
  return settings;
}

void Device::keep_settings(SettingsStore store, const std::optional<DeviceSettings>& saved) {
  if (saved) {
    if (const auto wrong = out_of_range(*saved, channels().size())) {
      throw std::invalid_argument(
          fmt::format("Device::keep_settings: {} is out of its range", *wrong));
    }
    settings_ = *saved;
  }
  store_ = std::move(store);
  saved_ = saved;
  changed();
}

// Time.

void Device::advance(double seconds) {
  if (!(seconds >= 0.0) || uptime_s() + seconds > longest_time_s) {
    throw std::domain_error(fmt::format(
        "Device::advance: expected seconds >= 0, up to 100 years in all, found {}", seconds));
  }
  run_until(uptime_ + to_device_time(seconds));
}

void Device::run_until(DeviceTime end) {
  for (DeviceTime next = next_event(); next <= end; next = next_event()) {
    uptime_ = std::max(uptime_, next);
    happen();
  }
  uptime_ = end;
}

/// Each of these is over once it has happened, so that run_until() comes to an end.
DeviceTime Device::next_event() const {
  DeviceTime next = DeviceTime::max();
  const DeviceTime warm_up = to_device_time(behaviour().warm_up_s);
  if (uptime_ < warm_up) {
    next = warm_up;
  }
  if (next_fault_ < behaviour().faults.size()) {
    next = std::min(next, to_device_time(behaviour().faults[next_fault_].after_s));
  }
  if (activity_) {
    next = std::min(next, activity_->next);
  }
  if (calibrated_at_ && !is_overdue_) {
    next = std::min(next, *calibrated_at_ + to_device_time(behaviour().calibration_interval_s));
  }
  return next;
}

void Device::happen() {
  const std::vector<TimedFault>& faults = behaviour().faults;
  for (; next_fault_ < faults.size() && to_device_time(faults[next_fault_].after_s) <= uptime_;
       ++next_fault_) {
    (void)set_fault(faults[next_fault_].fault, true, faults[next_fault_].magnitude);
  }
  if (calibrated_at_ && !is_overdue_ &&
      *calibrated_at_ + to_device_time(behaviour().calibration_interval_s) <= uptime_) {
    is_overdue_ = true;
    raise(Alarm::calibration_overdue);
  }
  if (activity_ && activity_->next <= uptime_) {
    proceed();
  }
  changed();
}

void Device::changed() {
  status_.state = present_state();
  status_.is_calibration_due = !calibrated_at_ || is_overdue_;
  status_.is_reference_set = settings_.has_reference;
  ++revision_;
}

DeviceState Device::present_state() const {
  if (head_.is_on(InstrumentFault::lamp_failure)) {
    return DeviceState::fault;
  }
  if (activity_) {
    return activity_->command == DeviceCommand::measure ? DeviceState::measuring
                                                        : DeviceState::calibrating;
  }
  return uptime_ < to_device_time(behaviour().warm_up_s) ? DeviceState::warm_up : DeviceState::idle;
}

double Device::uptime_s() const { return to_seconds(uptime_); }

double Device::temperature_c() const { return gonio::temperature_c(behaviour(), uptime_s()); }

double Device::since_calibration_s() const {
  return calibrated_at_ ? to_seconds(uptime_ - *calibrated_at_)
                        : std::numeric_limits<double>::infinity();
}

void Device::place(PortCover cover, int sample) {
  head_.place(cover, sample);
  status_.cover = head_.cover();
  status_.sample = head_.sample();
  changed();
}

std::optional<std::string> Device::set(const DeviceSettings& settings) {
  if (auto wrong = out_of_range(settings, channels().size())) {
    return wrong;
  }
  settings_ = settings;
  changed();
  return std::nullopt;
}

bool Device::set_fault(InstrumentFault fault, bool on, double magnitude) {
  if (!head_.set_fault(fault, on, magnitude)) {
    return false;
  }
  const std::uint32_t bit = 1U << unsigned(fault);
  status_.faults = on ? status_.faults | bit : status_.faults & ~bit;
  if (fault == InstrumentFault::lamp_failure && on) {
    raise(Alarm::lamp_failure);
    if (activity_) {
      end_activity(DeviceError::lamp_failure);
    }
  }
  changed();
  return true;
}

}  // namespace gonio

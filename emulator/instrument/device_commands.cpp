#include <algorithm>
#include <utility>

#include "emulator/instrument/device.hpp"

// What becomes of the commands of a device, and what runs for a while because of one.

namespace gonio {

namespace {

ChannelValue difference_of(const ChannelValue& reading, double reference_gu) {
  ChannelValue difference = reading;
  if (reading.status == ReadingStatus::valid) {
    difference.gloss_gu -= reference_gu;
  }
  return difference;
}

Verdict verdict_of(const ChannelValue& reading, const DeviceSettings::ByChannel& limits) {
  switch (reading.status) {
    case ReadingStatus::not_measured:
      return Verdict::none;
    case ReadingStatus::over_range:
      return Verdict::above;
    case ReadingStatus::valid:
      break;
  }
  return reading.gloss_gu < limits.lower_limit_gu   ? Verdict::below
         : reading.gloss_gu > limits.upper_limit_gu ? Verdict::above
                                                    : Verdict::pass;
}

}  // namespace

bool Device::command(DeviceCommand command) {
  if (activity_ && command != DeviceCommand::stop && command != DeviceCommand::acknowledge_alarms) {
    return false;
  }
  status_.command = {.command = command,
                     .state = CommandState::running,
                     .sequence = std::uint16_t(status_.command.sequence + 1)};
  const bool takes_time = command == DeviceCommand::measure ||
                          command == DeviceCommand::calibrate || command == DeviceCommand::zero;
  const DeviceError error = takes_time ? refusal(command) : carry_out(command);
  if (error != DeviceError::none) {
    conclude(CommandState::failed, error);
  } else if (takes_time) {
    begin(command);
    run_until(uptime_);  // what takes no time is over at once
  } else {
    conclude(CommandState::done);
  }
  changed();
  return true;
}

DeviceError Device::refusal(DeviceCommand command) const {
  if (present_state() == DeviceState::fault) {
    return DeviceError::lamp_failure;
  }
  if (present_state() == DeviceState::warm_up) {
    return DeviceError::warming_up;
  }
  if (command == DeviceCommand::calibrate) {
    return head_.cover() == PortCover::tile ? DeviceError::none : DeviceError::not_on_tile;
  }
  if (command == DeviceCommand::zero) {
    return head_.cover() == PortCover::black_trap ? DeviceError::none : DeviceError::not_on_trap;
  }
  if (behaviour().calibration_required && !calibrated_at_) {
    return DeviceError::not_calibrated;
  }
  if (settings_.mode == MeasuringMode::difference && !settings_.has_reference) {
    return DeviceError::no_reference;
  }
  return DeviceError::none;
}

DeviceError Device::carry_out(DeviceCommand command) {
  switch (command) {
    case DeviceCommand::stop:
      activity_.reset();
      status_.readings_left = 0;
      return DeviceError::none;
    case DeviceCommand::acknowledge_alarms:
      status_.alarms = 0;
      return DeviceError::none;
    case DeviceCommand::store_reference:
      return store_reference();
    case DeviceCommand::clear_statistics:
      clear_statistics();
      return DeviceError::none;
    case DeviceCommand::save_settings:
      return save_settings();
    case DeviceCommand::restore_settings:
      settings_ = saved_.value_or(factory_settings());
      return DeviceError::none;
    case DeviceCommand::factory_settings:
      settings_ = factory_settings();
      return DeviceError::none;
    case DeviceCommand::restart:
      power_on();
      return DeviceError::none;
    default:
      return DeviceError::unknown_command;
  }
}

DeviceError Device::save_settings() {
  try {
    if (store_) {
      store_(settings_);
      saved_ = settings_;
      return DeviceError::none;
    }
  } catch (...) {
    // A store that fails is no reason for the instrument to stop: it says so below.
  }
  raise(Alarm::storage_failed);
  return DeviceError::storage_failed;
}

DeviceError Device::store_reference() {
  DeviceSettings settings = settings_;
  settings.has_reference = true;
  for (std::size_t i = 0; i < channels().size(); ++i) {
    const ChannelValue& reading = status_.channels[i].reading;
    if (settings.channels[i].is_measured && reading.status != ReadingStatus::valid) {
      return DeviceError::no_reading;
    }
    if (settings.channels[i].is_measured) {
      settings.channels[i].reference_gu = reading.gloss_gu;
    }
  }
  if (out_of_range(settings, channels().size())) {
    return DeviceError::no_reading;  // of an instrument without a full scale, gone wild
  }
  settings_ = settings;
  return DeviceError::none;
}

void Device::conclude(CommandState state, DeviceError error) {
  status_.command.state = state;
  status_.command.error = error;
}

void Device::begin(DeviceCommand command) {
  const double duration_s =
      command == DeviceCommand::measure ? behaviour().reading_s : behaviour().calibration_s;
  activity_ = {.command = command,
               .sequence = status_.command.sequence,
               .begin = uptime_,
               .next = uptime_ + to_device_time(duration_s),
               .settings = settings_};
  if (command != DeviceCommand::measure) {
    return;
  }
  const MeasuringMode mode = settings_.mode;
  if (mode == MeasuringMode::statistics || mode == MeasuringMode::continuous) {
    clear_statistics();
  }
  status_.readings_left = mode == MeasuringMode::statistics   ? settings_.statistics_readings
                          : mode == MeasuringMode::continuous ? 0
                                                              : 1;
}

void Device::proceed() {
  if (activity_->command == DeviceCommand::calibrate) {
    end_activity(finish_calibration());
  } else if (activity_->command == DeviceCommand::zero) {
    end_activity(finish_zero());
  } else {
    take_reading();
    if (activity_->settings.mode == MeasuringMode::continuous) {
      activity_->next += std::max(to_device_time(behaviour().reading_s),
                                  to_device_time(activity_->settings.interval_s));
    } else if (--status_.readings_left == 0) {
      end_activity(DeviceError::none);
    } else {
      activity_->next += to_device_time(behaviour().reading_s);
    }
  }
}

/// Its command may no longer be the last one, of which alone there is an outcome.
void Device::end_activity(DeviceError error) {
  if (activity_->sequence == status_.command.sequence) {
    conclude(error == DeviceError::none ? CommandState::done : CommandState::failed, error);
  }
  status_.readings_left = 0;
  activity_.reset();
}

void Device::take_reading() {
  const DeviceSettings& settings = activity_->settings;
  const std::vector<ChannelValue> readings = head_.read(uptime_s());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const DeviceSettings::ByChannel& own = settings.channels[i];
    ChannelStatus& status = status_.channels[i];
    status.reading = own.is_measured ? readings[i] : ChannelValue{};
    status.difference = settings.mode == MeasuringMode::difference
                            ? difference_of(status.reading, own.reference_gu)
                            : ChannelValue{};
    status.verdict =
        settings.mode == MeasuringMode::pass_fail ? verdict_of(status.reading, own) : Verdict::none;
    if (status.reading.status == ReadingStatus::valid) {
      statistics_[i].add(status.reading.gloss_gu);
      status.statistics = statistics_[i].result();
    } else if (status.reading.status == ReadingStatus::over_range) {
      raise(Alarm::over_range);
    }
  }
  ++status_.sequence;
}

DeviceError Device::finish_calibration() {
  if (head_.cover() != PortCover::tile) {
    return DeviceError::not_on_tile;  // taken away meanwhile
  }
  std::vector<double> tile_gu;
  for (const DeviceSettings::ByChannel& channel : activity_->settings.channels) {
    tile_gu.push_back(channel.tile_gu);
  }
  const auto found = head_.calibrate(to_seconds(activity_->begin), uptime_s(), tile_gu);
  for (std::size_t i = 0; i < channels().size(); ++i) {
    status_.channels[i].calibration_deviation_gu = found.by_channel_gu[i];
    status_.channels[i].is_calibrated = status_.channels[i].is_calibrated || found.is_accepted;
  }
  if (!found.is_accepted) {
    raise(Alarm::tile_refused);
    return DeviceError::tile_out_of_tolerance;
  }
  calibrated_at_ = uptime_;
  is_overdue_ = false;
  return DeviceError::none;
}

DeviceError Device::finish_zero() {
  if (head_.cover() != PortCover::black_trap) {
    return DeviceError::not_on_trap;
  }
  const auto found = head_.zero(to_seconds(activity_->begin), uptime_s());
  for (std::size_t i = 0; i < channels().size(); ++i) {
    status_.channels[i].zero_offset_gu = found.by_channel_gu[i];
  }
  if (!found.is_accepted) {
    raise(Alarm::zero_refused);
    return DeviceError::zero_out_of_tolerance;
  }
  return DeviceError::none;
}

void Device::clear_statistics() {
  statistics_.assign(channels().size(), {});
  for (ChannelStatus& channel : status_.channels) {
    channel.statistics = {};
  }
}

}  // namespace gonio

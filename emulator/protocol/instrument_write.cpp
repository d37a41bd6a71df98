#include "emulator/protocol/instrument_write.hpp"

#include <algorithm>
#include <chrono>
#include <type_traits>

namespace gonio {

using modbus::Exception;

namespace {

std::uint32_t bit_of(InstrumentFault fault) { return 1U << static_cast<unsigned>(fault); }

bool is_in(double number, double low, double high) { return number >= low && number <= high; }

}  // namespace

InstrumentWrite::InstrumentWrite(const Device& device, const UnitState& state)
    : state_(state),
      settings_(device.settings()),
      cover_(device.status().cover),
      faults_(device.status().faults) {
  state_.sample = present_sample(device, state);
}

bool InstrumentWrite::gather(const std::string& value, std::size_t channel, double number) {
  return instrument_setters().at(value).gather(*this, channel, number);
}

Exception InstrumentWrite::try_on(Device& copy, const FaultPlan& faults) const {
  if (settings_ != copy.settings() && copy.set(settings_)) {
    return Exception::illegal_data_value;
  }
  const auto samples = static_cast<int>(copy.samples().size());
  const bool is_on_sample = cover_ == PortCover::sample;
  const bool is_form_wrong = state_.wire_fault.first > state_.wire_fault.last;
  if ((is_on_sample && state_.sample >= samples) ||
      (is_form_wrong && rule_action_ == RuleAction::add) || !set_faults(copy)) {
    return Exception::illegal_data_value;
  }
  if (rule_action_ == RuleAction::add && faults.is_full()) {
    return Exception::server_device_failure;
  }
  if (is_placed_) {
    copy.place(cover_, is_on_sample ? state_.sample : 0);
  }
  for (const DeviceCommand command : commands_) {
    if (!copy.command(command)) {
      return Exception::server_device_busy;
    }
  }
  return Exception::none;
}

bool InstrumentWrite::set_faults(Device& copy) const {
  for (std::size_t i = 0; i < instrument_fault_count; ++i) {
    const auto fault = static_cast<InstrumentFault>(i);
    const bool is_on = (faults_ & bit_of(fault)) != 0;
    const bool was_on = (copy.status().faults & bit_of(fault)) != 0;
    const double magnitude = fault == InstrumentFault::drift_step   ? state_.drift_step
                             : fault == InstrumentFault::tile_dirty ? state_.tile_dirty
                                                                    : 0.0;
    const bool is_touched = (touched_faults_ & bit_of(fault)) != 0;
    if ((is_on != was_on || (is_on && is_touched)) && !copy.set_fault(fault, is_on, magnitude)) {
      return false;
    }
  }
  return true;
}

FaultRule InstrumentWrite::rule() const {
  const UnitState::WireFaultForm& form = state_.wire_fault;
  constexpr std::uint16_t every = UnitState::WireFaultForm::every;
  FaultRule rule{.fault = form.fault,
                 .time = std::chrono::milliseconds(form.time_ms),
                 .probability = form.probability_ppm * 1e-6};
  if (form.fault == WireFault::exception) {
    rule.code = form.code;
  }
  if (form.unit != every) {
    rule.unit = static_cast<std::uint8_t>(form.unit);
  }
  if (form.function != every) {
    rule.function = static_cast<std::uint8_t>(form.function);
  }
  if (form.first != 0 || form.last != every) {
    rule.addresses = {form.first, form.last};
  }
  if (form.count != 0) {
    rule.count = form.count;
  }
  return rule;
}

void InstrumentWrite::apply(UnitState& state, FaultPlan& faults) const {
  state = state_;
  if (rule_action_ == RuleAction::add) {
    faults.add(rule());
  } else if (rule_action_ == RuleAction::clear) {
    faults.clear();
  }
}

/// The table of setters. Values of points with symbols are among them: no setter checks that again.
struct InstrumentSetters {
  using Setters = std::map<std::string, InstrumentSetter>;
  using Write = InstrumentWrite;

  static Setters all() {
    Setters setters;
    add_settings(setters);
    add_channel_settings(setters);
    add_commands(setters);
    add_simulation(setters);
    add_wire_fault(setters);
    return setters;
  }

 private:
  /// A setter of a value of the whole instrument, which any number suits.
  template <class Set>
  static InstrumentSetter plain(Set set) {
    return {.gather = [set](Write& write, std::size_t, double number) {
      set(write, number);
      return true;
    }};
  }

  template <class Set>
  static InstrumentSetter setting(Set set) {
    return {.gather = [set](Write& write, std::size_t,
                            double number) { return set(write.settings_, number); },
            .is_setting = true};
  }

  static void add_settings(Setters& setters) {
    setters["settings_lock"] = plain(
        [](Write& write, double number) { write.state_.are_settings_locked = number == 1.0; });
    setters["mode"] = setting([](DeviceSettings& settings, double number) {
      settings.mode = static_cast<MeasuringMode>(number);
      return true;
    });
    setters["statistics_readings"] = setting([](DeviceSettings& settings, double number) {
      settings.statistics_readings = static_cast<int>(number);
      return true;
    });
    setters["interval"] = setting([](DeviceSettings& settings, double number) {
      settings.interval_s = number;
      return true;
    });
    setters["has_reference"] = setting([](DeviceSettings& settings, double number) {
      settings.has_reference = number == 1.0;
      return true;
    });
    setters["measured_channels"] = setting([](DeviceSettings& settings, double number) {
      const auto mask = static_cast<unsigned>(number);
      for (std::size_t i = 0; i < settings.channels.size(); ++i) {
        settings.channels[i].is_measured = (mask >> i & 1U) != 0;
      }
      return mask >> settings.channels.size() == 0;
    });
  }

  static void add_channel_settings(Setters& setters) {
    using Setting = DeviceSettings::ByChannel;
    const auto add = [&](const char* name, double Setting::*field) {
      setters[name] = {.gather =
                           [field](Write& write, std::size_t channel, double number) {
                             write.settings_.channels.at(channel).*field = number;
                             return true;
                           },
                       .is_setting = true};
    };
    add("reference", &Setting::reference_gu);
    add("lower_limit", &Setting::lower_limit_gu);
    add("upper_limit", &Setting::upper_limit_gu);
    add("tile", &Setting::tile_gu);
  }

  static void add_commands(Setters& setters) {
    setters["command"] = plain([](Write& write, double number) {
      if (const auto command = static_cast<DeviceCommand>(number); command != DeviceCommand::none) {
        write.commands_.push_back(command);
      }
    });
    const auto add = [&](const char* name, DeviceCommand command) {
      setters[name] = plain([command](Write& write, double number) {
        if (number == 1.0) {
          write.commands_.push_back(command);
        }
      });
    };
    add("run_measure", DeviceCommand::measure);
    add("run_calibrate", DeviceCommand::calibrate);
    add("run_zero", DeviceCommand::zero);
    add("run_stop", DeviceCommand::stop);
    add("run_acknowledge_alarms", DeviceCommand::acknowledge_alarms);
  }

  static void add_simulation(Setters& setters) {
    setters["cover"] = plain([](Write& write, double number) {
      write.cover_ = static_cast<PortCover>(number);
      write.is_placed_ = true;
    });
    setters["sample"] = plain([](Write& write, double number) {
      write.state_.sample = static_cast<int>(number);
      write.is_placed_ = write.is_placed_ || write.cover_ == PortCover::sample;
    });
    setters["faults"] = plain(
        [](Write& write, double number) { write.faults_ = static_cast<std::uint32_t>(number); });
    const auto add = [&](const char* name, double UnitState::*field, InstrumentFault fault) {
      const double low = fault == InstrumentFault::drift_step ? -1.0 : 0.0;
      const double high = fault == InstrumentFault::drift_step ? 10.0 : 1.0;
      setters[name] = {.gather = [=](Write& write, std::size_t, double number) {
        write.state_.*field = number;
        write.touched_faults_ |= bit_of(fault);
        return is_in(number, low, high);
      }};
    };
    add("drift_step", &UnitState::drift_step, InstrumentFault::drift_step);
    add("tile_dirty", &UnitState::tile_dirty, InstrumentFault::tile_dirty);
  }

  static void add_wire_fault(Setters& setters) {
    using Form = UnitState::WireFaultForm;
    constexpr double highest = 65535.0;
    const auto add = [&](const char* name, auto field, double low, double high) {
      setters[name] = {.gather = [=](Write& write, std::size_t, double number) {
        auto& place = write.state_.wire_fault.*field;
        place = static_cast<std::remove_reference_t<decltype(place)>>(number);
        return is_in(number, low, high) || number == Form::every;
      }};
    };
    add("wire_fault", &Form::fault, 0.0, highest);
    add("wire_fault_unit", &Form::unit, 1.0, 247.0);
    add("wire_fault_function", &Form::function, 1.0, 127.0);
    add("wire_fault_first", &Form::first, 0.0, highest);
    add("wire_fault_last", &Form::last, 0.0, highest);
    add("wire_fault_count", &Form::count, 0.0, highest);
    add("wire_fault_probability", &Form::probability_ppm, 0.0, 1e6);
    add("wire_fault_time", &Form::time_ms, 0.0, highest);
    add("wire_fault_code", &Form::code, 0.0, highest);
    setters["wire_fault_apply"] = plain([](Write& write, double number) {
      write.rule_action_ = static_cast<Write::RuleAction>(number);
    });
  }
};

const std::map<std::string, InstrumentSetter>& instrument_setters() {
  static const std::map<std::string, InstrumentSetter> setters = InstrumentSetters::all();
  return setters;
}

}  // namespace gonio

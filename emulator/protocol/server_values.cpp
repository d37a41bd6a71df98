#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emulator/protocol/value_readers.hpp"

namespace gonio::value_readers {

namespace {

void add_simulation(Values& values) {
  const auto add = [&](const char* name, auto read) { values.emplace(name, whole(read)); };
  add("cover", [](const View& v) { return number_of(status(v).cover); });
  add("sample", [](const View& v) { return present_sample(v.device, v.state); });
  add("sample_count", [](const View& v) { return v.device.samples().size(); });
  add("faults", [](const View& v) { return status(v).faults; });
  add("drift_step", [](const View& v) { return v.state.drift_step; });
  add("tile_dirty", [](const View& v) { return v.state.tile_dirty; });
  values.emplace("sample_id", text([](const View& v) {
                   const auto sample = std::size_t(present_sample(v.device, v.state));
                   const std::vector<DeviceSample>& samples = v.device.samples();
                   return sample < samples.size() ? samples[sample].id : std::string();
                 }));
}

void add_wire_faults(Values& values) {
  using Form = UnitState::WireFaultForm;
  const auto add = [&](const char* name, auto read) {
    values.emplace(name, whole([read](const View& v) { return read(v.state.wire_fault); }));
  };
  add("wire_fault", [](const Form& form) { return number_of(form.fault); });
  add("wire_fault_unit", [](const Form& form) { return form.unit; });
  add("wire_fault_function", [](const Form& form) { return form.function; });
  add("wire_fault_first", [](const Form& form) { return form.first; });
  add("wire_fault_last", [](const Form& form) { return form.last; });
  add("wire_fault_count", [](const Form& form) { return form.count; });
  add("wire_fault_probability", [](const Form& form) { return form.probability_ppm; });
  add("wire_fault_time", [](const Form& form) { return form.time_ms; });
  add("wire_fault_code", [](const Form& form) { return number_of(form.code); });
  add("wire_fault_apply", [](const Form&) { return 0; });
  values.emplace("wire_fault_rules",
                 counter([](const View& v) { return v.faults.rules().size(); }));
}

void add_counters(Values& values) {
  const auto add = [&](const char* name, std::uint64_t Counters::*count) {
    values.emplace(name, counter([count](const View& v) { return v.counters.*count; }));
  };
  add("requests", &Counters::requests);
  add("exceptions", &Counters::exceptions);
  add("connections", &Counters::connections);
  add("refused_connections", &Counters::refused_connections);
  add("open_connections", &Counters::open_connections);
  add("corrupt_headers", &Counters::corrupt_headers);
  add("dropped_rtu_frames", &Counters::dropped_rtu_frames);
  add("injected_faults", &Counters::injected_faults);
  using modbus::FunctionCode;
  for (const auto code :
       {FunctionCode::read_coils, FunctionCode::read_discrete_inputs,
        FunctionCode::read_holding_registers, FunctionCode::read_input_registers,
        FunctionCode::write_single_coil, FunctionCode::write_single_register,
        FunctionCode::diagnostics, FunctionCode::write_multiple_coils,
        FunctionCode::write_multiple_registers, FunctionCode::report_server_id,
        FunctionCode::mask_write_register, FunctionCode::read_write_multiple_registers,
        FunctionCode::encapsulated_interface}) {
    const auto number = static_cast<std::size_t>(code);
    values.emplace(fmt::format("requests_function_{}", number),
                   counter([number](const View& v) { return v.counters.by_function.at(number); }));
  }
}

std::string angles(const View& view) {
  std::string result;
  for (const Channel& channel : view.device.channels()) {
    result += fmt::format("{}{:.0f}", result.empty() ? "" : "/", channel.theta_i.degrees());
  }
  return result + " deg";
}

void add_identity(Values& values) {
  const auto add = [&](const char* name, auto read) { values.emplace(name, text(read)); };
  add("serial_number", [](const View& v) { return v.device.identity().serial_number; });
  add("manufacturer", [](const View& v) { return v.device.identity().manufacturer; });
  add("model", [](const View& v) { return v.device.identity().model; });
  add("calibration_date", [](const View& v) { return v.device.identity().calibration_date; });
  add("angles", angles);
  add("firmware",
      [](const View& v) { return fmt::format("{}", fmt::join(v.firmware_version, ".")); });
  values.emplace("firmware_major", whole([](const View& v) { return v.firmware_version[0]; }));
  values.emplace("firmware_minor", whole([](const View& v) { return v.firmware_version[1]; }));
  values.emplace("firmware_patch", whole([](const View& v) { return v.firmware_version[2]; }));
  values.emplace("map_version", whole([](const View& v) { return v.map_version; }));
}

}  // namespace

void add_server_values(Values& values) {
  add_simulation(values);
  add_wire_faults(values);
  add_counters(values);
  add_identity(values);
}

}  // namespace gonio::value_readers

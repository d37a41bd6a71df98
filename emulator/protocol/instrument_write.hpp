#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "emulator/protocol/instrument_values.hpp"

namespace gonio {

/// What one request wants to write: values are gathered first, and then tried on a copy of the
/// device, so that it is all or nothing.
class InstrumentWrite {
 public:
  InstrumentWrite(const Device& device, const UnitState& state);

  /// Gathers one value of those in instrument_setters().
  /// @return  false if it is out of its range.
  [[nodiscard]] bool gather(const std::string& value, std::size_t channel, double number);

  /// Changes a copy of the device: settings first, then what lies on the port and what is broken,
  /// commands last.
  /// @return  why not, or none.
  [[nodiscard]] modbus::Exception try_on(Device& copy, const FaultPlan& faults) const;

  /// Changes the rest, after the copy took the place of the device.
  void apply(UnitState& state, FaultPlan& faults) const;

 private:
  friend struct InstrumentSetters;
  enum class RuleAction { none, add, clear };

  [[nodiscard]] FaultRule rule() const;
  [[nodiscard]] bool set_faults(Device& copy) const;

  UnitState state_;
  DeviceSettings settings_;
  PortCover cover_;
  bool is_placed_ = false;
  std::uint32_t faults_;  ///< bits by InstrumentFault
  std::uint32_t touched_faults_ = 0;
  RuleAction rule_action_ = RuleAction::none;
  std::vector<DeviceCommand> commands_;
};

/// How a value is gathered. @return  false if it is out of its range.
struct InstrumentSetter {
  std::function<bool(InstrumentWrite&, std::size_t channel, double number)> gather;
  bool is_setting = false;  ///< the lock keeps it from being written
};

/// All values that can be written, by name. Those of settings are checked by the device.
[[nodiscard]] const std::map<std::string, InstrumentSetter>& instrument_setters();

}  // namespace gonio

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "emulator/instrument/device.hpp"
#include "emulator/protocol/counters.hpp"
#include "emulator/protocol/fault_plan.hpp"

namespace gonio {

/// What the registers of an instrument hold and its device does not know.
struct UnitState {
  /// A fault on the wire as it is written down in registers; `every` for no restriction.
  struct WireFaultForm {
    static constexpr std::uint16_t every = 65535;
    WireFault fault = WireFault::delay;
    std::uint16_t unit = every, function = every;
    std::uint16_t first = 0, last = every;
    std::uint16_t count = 0;  ///< 0: for ever
    std::uint32_t probability_ppm = 1'000'000;
    std::uint16_t time_ms = 0;
    modbus::Exception code = modbus::Exception::server_device_failure;

    friend bool operator==(const WireFaultForm&, const WireFaultForm&) = default;
  };

  bool are_settings_locked = false;
  int sample = 0;  ///< that goes on the port when `cover` becomes a sample
  double drift_step = 0.0, tile_dirty = 0.0;  ///< magnitudes of those faults
  WireFaultForm wire_fault = {};

  friend bool operator==(const UnitState&, const UnitState&) = default;
};

/// All that can be read of an instrument, of one moment.
struct InstrumentView {
  const Device& device;
  const UnitState& state;
  const Counters& counters;
  const FaultPlan& faults;
  bool is_simulated = true;  ///< shows the registers of the simulation
  int map_version = 1;
  std::array<int, 3> firmware_version{};  ///< major, minor, patch
};

/// How a value that the register map names is read; one of the two functions.
struct InstrumentValue {
  /// @param channel  0 if the value is not by channel; less than the channels of the device.
  /// @return  NaN if there is none, infinity over range.
  std::function<double(const InstrumentView&, std::size_t channel)> number = {};
  std::function<std::string(const InstrumentView&)> text = {};
  /// Changes without the device: has to be asked for each time.
  bool is_counter = false;
};

/// All values by name.
[[nodiscard]] const std::map<std::string, InstrumentValue>& instrument_values();

/// The number of the sample that lies on the port, or would.
[[nodiscard]] int present_sample(const Device& device, const UnitState& state);

}  // namespace gonio

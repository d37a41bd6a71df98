#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/protocol/client.hpp"
#include "emulator/protocol/device_view.hpp"

// How one talks with a device over more than one request.

namespace gonio {

/// A device that answers busy is asked for so long.
inline constexpr std::chrono::seconds busy_patience{5};

/// Lets time pass before a device is asked again. Modbus has no way to be told when something has
/// happened, and to ask without a pause would keep others from the line.
void pause_between_questions();

/// Calls `request` until the device is no longer busy. @return  what it returns.
/// @throws ModbusExceptionError  that of the last try.
template <class Request>
auto retry_while_busy(std::chrono::milliseconds patience, Request&& request) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;;) {
    try {
      return request();
    } catch (const ModbusExceptionError& error) {
      if (error.code() != modbus::Exception::server_device_busy ||
          std::chrono::steady_clock::now() >= deadline) {
        throw;
      }
    }
    pause_between_questions();
  }
}

/// A point that the program relies on.
[[nodiscard]] inline const Point& known_point(const std::string& id) {
  return *RegisterMap::standard().find(id);
}

/// A command that a device was given, and what becomes of it.
class GivenCommand {
 public:
  /// Gives it; again if the device is busy with what it did before.
  /// @param name  of a symbol of the point `command`, e.g. "measure".
  /// @throws std::invalid_argument  for a command that the map has not, and as ModbusClient does.
  GivenCommand(ModbusClient& client, std::string name, std::chrono::milliseconds patience);

  /// Waits until it is over.
  /// @return  the points last_command, command_state and command_error; nothing if it still runs at
  ///          the deadline.
  /// @throws DeviceRefusal  if someone else has given another command meanwhile.
  [[nodiscard]] std::optional<DeviceView> outcome(
      std::chrono::steady_clock::time_point deadline) const;

 private:
  [[nodiscard]] DeviceView read() const;

  ModbusClient& client_;
  std::string name_;
  double before_ = 0.0;  // number of the command before it
};

}  // namespace gonio

#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "emulator/core/quantity.hpp"
#include "emulator/protocol/client.hpp"
#include "emulator/protocol/register_map.hpp"

namespace gonio::app {

/// What every command that talks to a device is told.
struct DeviceOptions {
  std::string url;
  std::string timeout = "1 s";

  /// @throws std::invalid_argument, std::system_error  for a bad URL, and if nobody answers there.
  [[nodiscard]] ModbusClient connect() const;
};

void add_device_options(CLI::App& command, DeviceOptions& options);

/// "500 ms", or a number of seconds.
/// @param option   named in messages.
/// @throws std::invalid_argument  for what is no time, or not in that range.
[[nodiscard]] std::chrono::milliseconds parse_duration(const std::string& option,
                                                       const std::string& text,
                                                       const Range& range_s);

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

}  // namespace gonio::app

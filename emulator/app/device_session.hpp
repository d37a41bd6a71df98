#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "emulator/core/quantity.hpp"
#include "emulator/protocol/client.hpp"
#include "emulator/protocol/device_dialogue.hpp"

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

}  // namespace gonio::app

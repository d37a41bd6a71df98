#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "emulator/protocol/device_view.hpp"

namespace gonio::app {

/// All that a person wants to see of a device.
struct DeviceReport {
  std::string url;
  DeviceView view;
  std::optional<DeviceView> simulation = {};  ///< nothing of a device that has none, or hides it

  [[nodiscard]] static DeviceReport read(ModbusClient& client);
};

/// @param styled  with colours, for a terminal.
[[nodiscard]] std::string device_text(const DeviceReport& report, bool styled);
[[nodiscard]] std::string device_json(const DeviceReport& report);  ///< schema gonio/device/1
[[nodiscard]] std::string device_csv(const DeviceReport& report);   ///< one line per channel

/// The readings alone, as a table. @param view  of the blocks status, readings, statistics and
/// channels.
[[nodiscard]] std::string readings_text(const DeviceView& view, bool styled);

[[nodiscard]] int channel_count(const DeviceView& view);
/// The value of a channel, from 1, e.g. of ("gloss", 1).
[[nodiscard]] double channel_number(const DeviceView& view, const char* id, int channel);
[[nodiscard]] std::string channel_text(const DeviceView& view, const char* id, int channel);
/// Since the last calibration; nothing before the first.
[[nodiscard]] std::optional<double> calibration_age_s(const DeviceView& view);
/// null unless finite.
[[nodiscard]] nlohmann::ordered_json json_number(double value);

/// So many decimals; "-" for NaN, "over range" for infinity.
[[nodiscard]] std::string decimals_text(double value, int decimals);

/// The text in a colour of the terminal, e.g. colour::red.
namespace colour {
inline constexpr int none = 0, bold = 1, red = 31, green = 32, yellow = 33;
}
[[nodiscard]] std::string painted(const std::string& text, int colour, bool styled);

}  // namespace gonio::app

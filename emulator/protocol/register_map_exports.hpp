#pragma once

#include <string>

#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// All of the map as an OpenModbus device profile.
/// @see OpenModbus device register map, schema 0.3.0
[[nodiscard]] std::string openmodbus_yaml(const RegisterMap& map);

/// The monitored blocks for Telegraf's inputs.modbus, in as few requests as the protocol allows, so
/// that what lies together is of one moment.
[[nodiscard]] std::string telegraf_toml(const RegisterMap& map);

/// The monitored blocks as sensors of Home Assistant's integration modbus.
[[nodiscard]] std::string home_assistant_yaml(const RegisterMap& map);

}  // namespace gonio

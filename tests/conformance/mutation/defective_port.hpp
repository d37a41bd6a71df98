#pragma once

#include <map>
#include <memory>
#include <string>

#include "tests/conformance/device_port.hpp"

namespace gonio::conformance {

/// Makes a sound device one with a defect in what it does or shows.
using PortDefect = std::shared_ptr<DevicePort> (*)(std::shared_ptr<DevicePort> sound);

/// All of them by name, e.g. stale_reading.
[[nodiscard]] const std::map<std::string, PortDefect>& port_defects();

}  // namespace gonio::conformance

#pragma once

#include "tests/conformance/device_under_test.hpp"

namespace gonio::conformance {

/// Whether it names a device on a wire: modbus:// or modbus-rtu:
[[nodiscard]] bool is_device_url(const std::string& text);

/// A device on Modbus: a glossmeter that speaks the register map, or for a protocol any server.
/// @throws std::invalid_argument, InputError  for options that are wrong, DeviceLost  if a
///         glossmeter does not answer.
[[nodiscard]] DeviceUnderTest served_device(const DeviceOptions& options,
                                            const ConformanceSuite& suite);

}  // namespace gonio::conformance

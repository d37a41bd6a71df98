#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "tests/conformance/run.hpp"

namespace gonio::conformance {

/// Which device is judged.
struct DeviceOptions {
  std::string device = "nominal";  ///< nominal, an instrument, or a URL
  std::string timeout = "1 s";     ///< of an answer
  std::string patience = "60 s";   ///< while the device's own time passes
  bool asks = false;               ///< a person lays things on the port
  std::string profile = "gonio";   ///< of a server: what stands at which address; a name or a file
};

void add_device_options(CLI::App& program, DeviceOptions& options);

/// @throws InputError, std::invalid_argument  for what is no device, DeviceLost  if it does not
///         answer.
[[nodiscard]] DeviceUnderTest find_device(const DeviceOptions& options,
                                          const ConformanceSuite& suite, std::uint64_t seed,
                                          const Catalog& catalog);

}  // namespace gonio::conformance

#pragma once

#include <chrono>
#include <memory>

#include "emulator/protocol/device_url.hpp"
#include "tests/conformance/exchange.hpp"

namespace gonio::conformance {

/// How long one waits for a server.
struct LinePatience {
  std::chrono::milliseconds reply{1000};  ///< for a connection, and for what must come
  /// For what must not come: several times what a reply takes, and less than a server waits for the
  /// rest of a request.
  std::chrono::milliseconds more{40};
};

/// A plain socket, or a serial line, to a server: nothing but what one sends is said. It is opened
/// by renew().
[[nodiscard]] std::unique_ptr<ProbedLine> probed_line(const DeviceUrl& url,
                                                      const LinePatience& patience = {});

}  // namespace gonio::conformance

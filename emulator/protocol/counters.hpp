#pragma once

#include <array>
#include <cstdint>

namespace gonio {

/// What a server has counted since it began; shown in registers and when it ends.
struct Counters {
  std::uint64_t requests = 0;    ///< answered or not
  std::uint64_t exceptions = 0;  ///< answered with an exception
  std::uint64_t connections = 0, refused_connections = 0, open_connections = 0;
  std::uint64_t corrupt_headers = 0;     ///< TCP connections closed for one
  std::uint64_t dropped_rtu_frames = 0;  ///< bad CRC and the like
  std::uint64_t injected_faults = 0;
  std::array<std::uint64_t, 128> by_function = {};
};

}  // namespace gonio

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gonio {

struct TcpOptions {
  std::string host = "127.0.0.1";
  std::uint16_t port = 502;          ///< 0: any free one
  std::size_t max_connections = 64;  ///< beyond it the one that was idle longest is closed
  std::chrono::milliseconds idle_timeout{60'000};
  /// Of a request that has begun, and of a reply that the peer does not take.
  std::chrono::milliseconds stall_timeout{5'000};
  std::size_t max_queue = 64 * 1024;    ///< bytes of replies for one peer
  std::vector<std::string> allow = {};  ///< addresses and networks (10.0.0.0/8); all if empty
};

enum class Parity { none, even, odd };

struct RtuOptions {
  std::string path;  ///< of a serial device, or "pty" to make a pseudo terminal
  int baud = 19200;
  Parity parity = Parity::even;          ///< without one there are two stop bits
  std::optional<std::string> link = {};  ///< symbolic link to the pseudo terminal
};

}  // namespace gonio

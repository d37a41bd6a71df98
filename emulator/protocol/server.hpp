#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/protocol/dispatcher.hpp"
#include "emulator/protocol/server_options.hpp"

namespace spdlog {
class logger;
}

namespace gonio {

/// Where a server listens.
struct Listening {
  std::optional<std::string> tcp = {};  ///< host:port
  std::optional<std::string> rtu = {};  ///< path of the serial device
};

/// A Modbus server: TCP, a serial line, or both, on one event loop in one thread.
class Server {
 public:
  /// @param dispatcher  outlives this, like the log.
  Server(Dispatcher& dispatcher, spdlog::logger& log);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Begins to listen; requests are answered once run() runs.
  /// @throws std::system_error      with the place that could not be had.
  /// @throws std::invalid_argument  for an address list that cannot be read.
  [[nodiscard]] Listening listen(const std::optional<TcpOptions>& tcp,
                                 const std::optional<RtuOptions>& rtu);

  /// Serves until stop(), SIGTERM or SIGINT.
  void run();
  /// Ends run(). May be called from any thread.
  void stop();

 private:
  struct Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace gonio

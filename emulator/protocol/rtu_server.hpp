#pragma once

#include <array>
#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/serial_port.hpp>
#include <asio/steady_timer.hpp>
#include <memory>
#include <string>
#include <vector>

#include "emulator/protocol/delivery.hpp"
#include "emulator/protocol/dispatcher.hpp"
#include "emulator/protocol/pseudo_terminal.hpp"
#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/server_options.hpp"

namespace spdlog {
class logger;
}

namespace gonio {

/// Modbus RTU on a serial device, or on a pseudo terminal that it makes.
///
/// A reply goes out when the silence of 3.5 characters has ended the request. A device that goes
/// away is opened again every second.
class RtuServer {
 public:
  RtuServer(asio::io_context& io, Dispatcher& dispatcher, spdlog::logger& log, RtuOptions options);

  /// @return  path of the device that clients open, or of the serial device.
  /// @throws std::system_error  with the path.
  [[nodiscard]] std::string listen();
  void stop();

 private:
  void open();
  void reopen();
  void watch_users();
  void receive();
  void await_silence();
  void on_silence();
  void answer(const modbus::RtuFrame& frame);
  void send(std::vector<std::uint8_t> bytes);

  Dispatcher& dispatcher_;
  spdlog::logger& log_;
  RtuOptions options_;
  std::unique_ptr<PseudoTerminal> terminal_;
  asio::serial_port port_;
  asio::posix::stream_descriptor watch_;  ///< of the users of the terminal
  asio::steady_timer silence_, pause_, reopen_;
  modbus::RtuFramer framer_;
  std::array<std::uint8_t, modbus::max_rtu_adu> input_{};
  bool is_sending_ = false;
};

}  // namespace gonio

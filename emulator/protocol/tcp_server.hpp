#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/steady_timer.hpp>
#include <memory>
#include <string>
#include <unordered_map>

#include "emulator/protocol/address_list.hpp"
#include "emulator/protocol/ready_set.hpp"
#include "emulator/protocol/tcp_connection.hpp"

namespace gonio {

/// Accepts connections and keeps account of them.
///
/// A connection beyond the limit takes the place of one that has never sent a request, the oldest
/// first, or else of the one that has been idle longest, if it has been for a second; else it is
/// refused: a flood of connections does not push out clients that are at work.
class TcpServer {
 public:
  /// @throws std::invalid_argument  for an address list that cannot be read.
  TcpServer(asio::io_context& io, Dispatcher& dispatcher, spdlog::logger& log, TcpOptions options);

  ~TcpServer();
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  /// @return  host:port that it listens on. @throws std::system_error  with host and port.
  [[nodiscard]] std::string listen();
  /// Serves what is ready now. @return  how many connections were.
  int poll() { return ready_.poll(); }
  /// Lets the event loop wake when a connection is ready, and serve it.
  void wake_when_ready();
  /// Closes everything.
  void stop();

 private:
  void accept();
  void admit(asio::ip::tcp::socket socket);
  [[nodiscard]] bool make_room();
  void sweep();

  ReadySet ready_;
  asio::posix::stream_descriptor any_ready_;  // ready_, as the event loop sees it
  bool is_armed_ = false;
  TcpOptions options_;
  AddressList allowed_;
  TcpConnection::Surroundings surroundings_;
  asio::ip::tcp::acceptor acceptor_;
  asio::steady_timer sweep_timer_, retry_timer_;
  bool is_short_ = false;  ///< of descriptors or memory, for another connection
  std::unordered_map<const TcpConnection*, std::shared_ptr<TcpConnection>> connections_;
};

}  // namespace gonio

#pragma once

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/protocol/delivery.hpp"
#include "emulator/protocol/dispatcher.hpp"
#include "emulator/protocol/ready_set.hpp"
#include "emulator/protocol/server_options.hpp"
#include "emulator/protocol/tcp_framer.hpp"

namespace spdlog {
class logger;
}

namespace gonio {

/// One client on TCP: cuts its bytes into requests, answers them in their order, and closes when
/// the header is corrupt or the peer stops half way.
///
/// It never holds more than one buffer of requests and `max_queue` bytes of replies: while the peer
/// does not take its replies, its requests stay in the kernel.
class TcpConnection final : public Watcher, public std::enable_shared_from_this<TcpConnection> {
 public:
  using Clock = std::chrono::steady_clock;

  struct Surroundings {
    asio::io_context& io;
    ReadySet& ready;
    Dispatcher& dispatcher;
    const TcpOptions& options;
    spdlog::logger& log;
    std::function<void(const TcpConnection&)> on_close;
  };

  /// @param socket  connected; closed by this.
  TcpConnection(int socket, Surroundings& surroundings, std::string peer);
  ~TcpConnection() override;
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  /// @throws std::system_error  if the socket cannot be waited for.
  void start();
  void on_ready() override;
  /// @param reason  for the log.
  void close(const char* reason);
  /// Closes it if it has been silent, or stuck half way, for too long.
  void close_if_overdue(Clock::time_point now);

  [[nodiscard]] bool was_used() const { return was_used_; }  ///< has sent a whole request
  [[nodiscard]] Clock::time_point last_activity() const { return last_activity_; }

 private:
  void release();
  void proceed();
  void receive();
  [[nodiscard]] bool answer_some();
  void answer(const modbus::TcpFrame& frame);
  void schedule(Delivery delivery);
  [[nodiscard]] bool send();
  void wait_for(ReadySet::Interest interest);

  int socket_;  ///< -1 once closed
  Surroundings& surroundings_;
  asio::steady_timer pause_;
  ReadySet::Interest interest_ = ReadySet::Interest::input;
  std::string peer_;
  modbus::TcpFramer framer_;
  std::vector<std::uint8_t> output_;
  std::size_t sent_ = 0;    ///< bytes of output_
  bool is_paused_ = false;  ///< an injected delay runs
  bool is_ending_ = false;  ///< the peer will send no more
  bool is_cut_ = false;     ///< an injected fault ends it
  bool was_used_ = false;
  Clock::time_point last_activity_ = Clock::now();
  Clock::time_point frame_began_{};
};

}  // namespace gonio

#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/wire/server_process.hpp"
#include "tests/wire/tcp_socket.hpp"

namespace gonio::test {

/// What a client went through.
struct Experience {
  std::vector<double> latencies_ms = {};
  /// The same without the time in which server or client were ready to run, but the kernel had no
  /// processor for them: what others on the machine are to blame for.
  std::vector<double> own_latencies_ms = {};
  std::string complaint = {};  ///< the first reply that was lost or wrong
};

/// A client that behaves: it reads known registers every 2 ms, on one connection and in a thread of
/// its own, with function codes 3 and 4 in turn, and looks at every byte of the reply.
class Victim {
 public:
  explicit Victim(const ServerProcess& server);
  ~Victim();
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;

  /// Requests since take(), or since it began.
  [[nodiscard]] std::size_t count();
  /// What it went through since this was asked last, or since it began.
  [[nodiscard]] Experience take();

 private:
  void run();
  /// @return  what is wrong; empty if nothing.
  [[nodiscard]] std::string ask(std::uint16_t transaction);

  pid_t server_;
  TcpSocket socket_;
  std::mutex mutex_;
  Experience experience_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

/// Lets an attack run while a client is at work: the client gets every reply, 99 of 100 within 5
/// ms; the server lives, and has closed everything in the end.
///
/// Lateness alone is tried again, up to three times, and is excused as far as the machine, which
/// may be shared, had no processor.
void expect_isolation(ServerProcess& server, const std::function<void()>& attack);

/// How long an attack goes on.
constexpr milliseconds attack_time{350};

}  // namespace gonio::test

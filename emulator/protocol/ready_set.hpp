#pragma once

#include <cstdint>
#include <memory>

namespace gonio {

/// What happens to a socket in a ReadySet.
class Watcher {
 public:
  virtual ~Watcher() = default;
  /// Input, room for output, or the end of the stream has come. May take its own socket out of the
  /// set, and no other one.
  virtual void on_ready() = 0;
};

/// Sockets of which the kernel is asked together which of them are ready (epoll). Asio asks it once
/// more for every wait of every socket, which costs a tenth of a request.
class ReadySet {
 public:
  enum class Interest : std::uint8_t { none, input, output };

  /// @throws std::system_error  if the kernel has none.
  ReadySet();
  ~ReadySet();
  ReadySet(const ReadySet&) = delete;
  ReadySet& operator=(const ReadySet&) = delete;

  /// @param watcher  outlives the socket's stay. A socket that is closed has left.
  /// @throws std::system_error  if the kernel refuses.
  void add(int socket, Watcher& watcher, Interest interest);
  void change(int socket, Watcher& watcher, Interest interest);

  /// Calls the watchers of all sockets that are ready now. @return  how many there were.
  int poll();

  /// Readable while a socket is ready: to be waited for in another loop.
  [[nodiscard]] int descriptor() const { return epoll_; }

 private:
  void control(int operation, int socket, Watcher& watcher, Interest interest);

  int epoll_;
};

}  // namespace gonio

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

  /// @param watcher  outlives the socket's stay.
  /// @throws std::system_error  if the kernel refuses.
  void add(int socket, Watcher& watcher, Interest interest);
  void change(int socket, Watcher& watcher, Interest interest);
  /// To be called before a socket is closed: the kernel knows it for as long as anybody holds a
  /// descriptor of it, such as a process that looks at those of this one. Without effect on a
  /// socket that is not in the set.
  void remove(int socket);

  /// Calls the watchers of all sockets that are ready now. @return  how many there were.
  int poll();

  /// Readable while a socket is ready: to be waited for in another loop.
  [[nodiscard]] int descriptor() const { return epoll_; }

 private:
  void control(int operation, int socket, Watcher& watcher, Interest interest);

  int epoll_;
};

}  // namespace gonio

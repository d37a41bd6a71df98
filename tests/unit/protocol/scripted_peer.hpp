#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace gonio::test {

using Bytes = std::vector<std::uint8_t>;

/// What a peer does with one request: sends pieces, then perhaps closes the connection.
struct Answer {
  std::vector<Bytes> pieces;
  bool closes = false;
};
using Script = std::vector<std::function<Answer(const Bytes& request)>>;

/// Sends a script's answers, one for each request, to whoever asks, and keeps the requests.
/// A request is what came in one piece, which on loopback is one request of a client that waits.
class ScriptedPeer {
 public:
  ScriptedPeer(const ScriptedPeer&) = delete;
  ScriptedPeer& operator=(const ScriptedPeer&) = delete;

  /// What was asked so far, whole ADUs.
  [[nodiscard]] std::vector<Bytes> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 protected:
  explicit ScriptedPeer(Script script) : script_(std::move(script)) {
    if (pipe(stop_.data()) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe");
    }
  }
  ~ScriptedPeer() {
    for (const int end : stop_) {
      close(end);
    }
  }

  void stop(std::thread& thread) {
    (void)!write(stop_[1], "", 1);
    thread.join();
  }

  /// @return  whether `file` has something to read; false when the peer is to stop.
  [[nodiscard]] bool wait_for(int file) const {
    std::array<pollfd, 2> files = {{{file, POLLIN, 0}, {stop_[0], POLLIN, 0}}};
    while (poll(files.data(), files.size(), -1) < 0 && errno == EINTR) {
    }
    return files[1].revents == 0;
  }

  /// Answers requests until the other side or the script closes. @param size  of a request, or 0
  /// for whatever comes in one piece.
  void serve(int file, std::size_t size) {
    Bytes request;
    while (wait_for(file)) {
      std::array<std::uint8_t, 512> buffer{};
      const auto count = read(file, buffer.data(), buffer.size());
      if (count <= 0) {
        return;
      }
      request.insert(request.end(), buffer.begin(), buffer.begin() + count);
      if (request.size() < size) {
        continue;
      }
      if (!answer(file, std::exchange(request, {}))) {
        return;
      }
    }
  }

 private:
  bool answer(int file, const Bytes& request) {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
    if (requests_.size() > script_.size()) {
      return false;
    }
    const Answer answer = script_[requests_.size() - 1](request);
    for (const Bytes& piece : answer.pieces) {
      if (write(file, piece.data(), piece.size()) < 0) {
        return false;
      }
    }
    return !answer.closes;
  }

  Script script_;
  mutable std::mutex mutex_;
  std::vector<Bytes> requests_;
  std::array<int, 2> stop_{};
};

/// On a free port of the loopback interface.
class TcpPeer : public ScriptedPeer {
 public:
  explicit TcpPeer(Script script) : ScriptedPeer(std::move(script)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (listener_ < 0 || bind(listener_, any, size) != 0 || listen(listener_, 8) != 0 ||
        getsockname(listener_, any, &size) != 0) {
      throw std::system_error(errno, std::generic_category(), "listen");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~TcpPeer() {
    stop(thread_);
    close(listener_);
  }

  [[nodiscard]] std::string url() const { return "modbus://127.0.0.1:" + std::to_string(port_); }

 private:
  void run() {
    while (wait_for(listener_)) {
      const int peer = accept(listener_, nullptr, nullptr);
      const int on = 1;
      setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      serve(peer, 0);
      close(peer);
    }
  }

  int listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int port_ = 0;
  std::thread thread_;
};

/// On a pseudo-terminal. Its requests have 8 bytes, as reads have.
class RtuPeer : public ScriptedPeer {
 public:
  explicit RtuPeer(Script script) : ScriptedPeer(std::move(script)) {
    std::array<char, 256> name{};
    if (openpty(&ours_, &theirs_, name.data(), nullptr, nullptr) != 0) {
      throw std::system_error(errno, std::generic_category(), "openpty");
    }
    path_ = name.data();
    termios settings{};
    tcgetattr(theirs_, &settings);
    cfmakeraw(&settings);
    tcsetattr(theirs_, TCSANOW, &settings);
    thread_ = std::thread([this] { serve(ours_, 8); });
  }
  ~RtuPeer() {
    stop(thread_);
    close(ours_);
    close(theirs_);
  }

  [[nodiscard]] std::string url() const { return "modbus-rtu:" + path_; }

 private:
  int ours_ = -1;
  int theirs_ = -1;  // stays open: without it the line is gone when a client leaves
  std::string path_;
  std::thread thread_;
};

}  // namespace gonio::test

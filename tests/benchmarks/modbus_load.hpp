#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace gonio::bench {

/// What a client does over and over: FC 3 of 10 registers, `depth` requests at once.
struct Load {
  std::uint16_t port = 0;
  std::uint16_t address = 0;
  int connections = 1;
  int depth = 1;
};

/// A closed loop of requests on several connections, without a Modbus library: the next request of
/// a connection goes out when the reply to the one before is there.
class LoadClient {
 public:
  static constexpr std::size_t request_size = 12, reply_size = 29;

  explicit LoadClient(const Load& load) : load_(load), epoll_(epoll_create1(EPOLL_CLOEXEC)) {
    for (int j = 0; j < load.depth; ++j) {
      const std::array<std::uint8_t, request_size> request = {
          0,
          static_cast<std::uint8_t>(j),
          0,
          0,
          0,
          6,
          1,
          3,
          static_cast<std::uint8_t>(load.address >> 8U),
          static_cast<std::uint8_t>(load.address & 0xFFU),
          0,
          10};
      requests_.insert(requests_.end(), request.begin(), request.end());
    }
    for (int j = 0; j < load.connections; ++j) {
      connect_one(std::size_t(j));
    }
  }
  ~LoadClient() {
    for (const Connection& connection : connections_) {
      close(connection.socket);
    }
    close(epoll_);
  }
  LoadClient(const LoadClient&) = delete;
  LoadClient& operator=(const LoadClient&) = delete;

  /// Asks `rounds` times on all connections together. @return  seconds that each round took.
  std::vector<double> run(int rounds) {
    std::vector<double> round_s;
    round_s.reserve(std::size_t(rounds));
    int started = 0;
    for (Connection& connection : connections_) {
      ++started;
      send_all(connection);
    }
    std::array<epoll_event, 128> events{};
    while (round_s.size() < std::size_t(started)) {
      const int count = epoll_wait(epoll_, events.data(), int(events.size()), 5000);
      if (count <= 0) {
        throw std::runtime_error("a server that does not answer");
      }
      for (int j = 0; j < count; ++j) {
        Connection& connection = connections_[events[std::size_t(j)].data.u64];
        if (receive(connection)) {
          const std::chrono::duration<double> elapsed = Clock::now() - connection.sent_at;
          round_s.push_back(elapsed.count());
          if (started < rounds) {
            ++started;
            send_all(connection);
          }
        }
      }
    }
    return round_s;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Connection {
    int socket = -1;
    std::size_t missing = 0;
    Clock::time_point sent_at = {};
  };

  void connect_one(std::size_t index) {
    Connection connection{.socket = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(load_.port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int on = 1;
    if (connect(connection.socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::system_error(errno, std::generic_category(), "connect");
    }
    setsockopt(connection.socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = index;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, connection.socket, &event);
    connections_.push_back(connection);
  }

  void send_all(Connection& connection) {
    connection.missing = reply_size * std::size_t(load_.depth);
    connection.sent_at = Clock::now();
    if (send(connection.socket, requests_.data(), requests_.size(), MSG_NOSIGNAL) !=
        ssize_t(requests_.size())) {
      throw std::system_error(errno, std::generic_category(), "send");
    }
  }

  /// @return  whether the last reply of the round is whole.
  bool receive(Connection& connection) {
    std::array<std::uint8_t, 4096> buffer{};
    const ssize_t count = recv(connection.socket, buffer.data(), buffer.size(), 0);
    if (count <= 0 || std::size_t(count) > connection.missing) {
      throw std::runtime_error("a reply of the wrong length");
    }
    connection.missing -= std::size_t(count);
    return connection.missing == 0;
  }

  Load load_;
  int epoll_;
  std::vector<std::uint8_t> requests_;
  std::vector<Connection> connections_;
};

/// @param share  0.99 for the 99th percentile. @param values  at least one.
inline double quantile(std::vector<double> values, double share) {
  const auto index = std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[std::size_t(index)];
}

}  // namespace gonio::bench

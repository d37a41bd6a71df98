#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "emulator/protocol/client.hpp"
#include "tests/system/program.hpp"

namespace gonio::test {

/// A file descriptor, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {
    if (number < 0) {
      throw std::system_error(errno, std::generic_category());
    }
  }
  ~Descriptor() { release(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  void release() {
    if (number_ >= 0) {
      close(number_);
    }
    number_ = -1;
  }
  /// Waits until it has something to read. @return  false if that does not happen in time.
  [[nodiscard]] bool is_readable_within(std::chrono::milliseconds time) const {
    pollfd waiting{.fd = number_, .events = POLLIN, .revents = 0};
    return poll(&waiting, 1, static_cast<int>(time.count())) == 1;
  }

 private:
  int number_;
};

// What takes longer than this is not going to happen.
inline constexpr std::chrono::seconds deadline{60};
inline constexpr std::chrono::seconds time_to_end{5};

/// A `gonio serve` that listens; it is killed at the end of its scope if it was not ended.
class ServeProcess {
 public:
  /// Starts it and waits for its first line on standard output.
  /// @param arguments  after `serve`.
  ServeProcess(const Program& program, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "serve");
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe2");
    }
    const Descriptor in(ends[0]);
    Descriptor out(ends[1]);
    process_ = program.start(arguments, out.number());
    out.release();
    char c = 0;
    while (in.is_readable_within(deadline) && read(in.number(), &c, 1) == 1 && c != '\n') {
      first_line_ += c;
    }
    if (c != '\n') {
      kill();
      throw std::runtime_error("gonio serve announces nothing");
    }
  }
  ~ServeProcess() { kill(); }
  ServeProcess(const ServeProcess&) = delete;
  ServeProcess& operator=(const ServeProcess&) = delete;

  [[nodiscard]] const std::string& first_line() const { return first_line_; }
  /// Where it listens, with --format json.
  [[nodiscard]] std::string tcp() const { return nlohmann::json::parse(first_line_).at("tcp"); }
  [[nodiscard]] std::string rtu() const { return nlohmann::json::parse(first_line_).at("rtu"); }
  [[nodiscard]] ModbusClient connect(int unit = 1) const {
    const std::string url = "modbus://" + tcp() + "/" + std::to_string(unit);
    return {DeviceUrl::parse(url), std::chrono::duration_cast<std::chrono::milliseconds>(deadline)};
  }

  /// Sends a signal and waits for the end. @return  exit status as in Outcome; -1 if it goes on.
  [[nodiscard]] int end(int signal = SIGTERM) {
    const Descriptor handle(static_cast<int>(syscall(SYS_pidfd_open, process_, 0)));
    ::kill(process_, signal);
    if (!handle.is_readable_within(time_to_end)) {
      return -1;
    }
    return Program::wait(std::exchange(process_, 0));
  }

 private:
  void kill() {
    if (process_ != 0) {
      ::kill(process_, SIGKILL);
      Program::wait(std::exchange(process_, 0));
    }
  }

  pid_t process_ = 0;
  std::string first_line_;
};

inline const std::string triangle = "triangle_gloss";

/// Arguments of a quiet server on any port of the loopback, and more.
inline std::vector<std::string> quietly(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"--format", "json", "--log-level", "warn"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// A connection over which nothing but what one sends is said.
inline int connect_to(const std::string& place) {
  const std::size_t colon = place.rfind(':');
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.substr(colon + 1))));
  inet_pton(AF_INET, place.substr(0, colon).c_str(), &address.sin_addr);
  const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::system_error(errno, std::generic_category(), "connect to " + place);
  }
  return connection;
}

}  // namespace gonio::test

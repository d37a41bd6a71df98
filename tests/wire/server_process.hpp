#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/wire/waiting.hpp"

namespace gonio::test {

/// More than a server needs; with sanitizers it is theirs.
#ifdef GONIO_SANITIZED
constexpr double largest_mib = 1000.0;
#else
constexpr double largest_mib = 50.0;
#endif

/// A server that is asked to make a pseudo terminal, too.
inline const std::vector<std::string> with_pty = {"--rtu", "pty", "--baud", "115200"};

/// A running `gonio serve`. It ends with the scope at the latest, by a signal, and has to do so
/// cleanly: with sanitizers that is without a leak.
class ServerProcess {
 public:
  /// How it is started, beside what `arguments` say.
  struct Setup {
    std::string instrument = "pocket_gloss_60";
    std::string tcp = "127.0.0.1:0";
    std::string preload = {};  ///< a library
  };

  /// Waits until it listens. @param arguments  of `serve`, e.g. {"--idle-timeout", "300 ms"}.
  explicit ServerProcess(const std::vector<std::string>& arguments, const Setup& setup);
  explicit ServerProcess(const std::vector<std::string>& arguments = {})
      : ServerProcess(arguments, Setup()) {}
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const std::string& serial_line() const { return serial_line_; }

  [[nodiscard]] bool is_alive();
  [[nodiscard]] std::size_t open_files() const;
  [[nodiscard]] double processor_s() const;  ///< that it has used so far
  [[nodiscard]] double resident_mib() const;
  void limit_open_files(std::size_t most) const;
  [[nodiscard]] std::string log() const;

  /// Sends a signal and waits. @return  its status, as in Outcome; -1 if it does not end in time.
  int end(int signal = SIGTERM);

 private:
  void read_announcement(int file);

  Program program_;
  pid_t id_ = -1;
  int status_ = -1;
  std::uint16_t port_ = 0;
  std::string serial_line_;
};

}  // namespace gonio::test

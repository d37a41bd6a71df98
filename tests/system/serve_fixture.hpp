#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>
#include <system_error>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/serve_process.hpp"

namespace gonio::test {

/// A pipe whose ends close with it.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe");
    }
  }
  ~Pipe() {
    close_in();
    close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] int in() const { return ends_[1]; }
  [[nodiscard]] int out() const { return ends_[0]; }
  void close_in() {
    if (ends_[1] >= 0) {
      close(ends_[1]);
      ends_[1] = -1;
    }
  }

 private:
  std::array<int, 2> ends_{};
};

/// What comes from `file` up to and with `end`, or all if that never comes.
inline std::string read_until(int file, const std::string& end) {
  std::string text;
  char c = 0;
  while (!text.ends_with(end) && read(file, &c, 1) == 1) {
    text += c;
  }
  return text;
}

/// `gonio serve` with triangle_gloss and two samples on a free port, until it is destroyed.
class ServedInstrument {
 public:
  /// @param more  arguments, e.g. {"--ideal"}.
  explicit ServedInstrument(const std::vector<std::string>& more)
      : process_(program_, arguments(more)) {}
  ~ServedInstrument() { EXPECT_EQ(process_.end(), 0); }
  ServedInstrument(const ServedInstrument&) = delete;
  ServedInstrument& operator=(const ServedInstrument&) = delete;

  [[nodiscard]] std::string url() const { return "modbus://" + process_.tcp(); }
  [[nodiscard]] std::string rtu_url() const { return "modbus-rtu:" + process_.rtu(); }

 private:
  static std::vector<std::string> arguments(const std::vector<std::string>& more) {
    std::vector<std::string> result{
        triangle, "--tcp",    "127.0.0.1:0",       "--format", "json",     "--log-level",
        "off",    "--sample", "black_glass_n1567", "--sample", "red_satin"};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  Program program_;
  ServeProcess process_;
};

}  // namespace gonio::test

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

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
  explicit ServedInstrument(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "serve",    "triangle_gloss", "--tcp", "127.0.0.1:0", "--format",
        "json",     "--log-level",    "off",   "--sample",    "black_glass_n1567",
        "--sample", "red_satin"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    process_ = program_.start(arguments, announcement_.in());
    announcement_.close_in();
    const std::string line = read_until(announcement_.out(), "\n");
    if (line.empty()) {
      Program::wait(process_);
      throw std::runtime_error("gonio serve did not begin");
    }
    listening_ = nlohmann::json::parse(line);
  }
  ~ServedInstrument() {
    kill(process_, SIGTERM);
    EXPECT_EQ(Program::wait(process_), 0);
  }
  ServedInstrument(const ServedInstrument&) = delete;
  ServedInstrument& operator=(const ServedInstrument&) = delete;

  [[nodiscard]] std::string url() const {
    return "modbus://" + listening_.at("tcp").get<std::string>();
  }
  [[nodiscard]] std::string rtu_url() const {
    return "modbus-rtu:" + listening_.at("rtu").get<std::string>();
  }

 private:
  Program program_;
  Pipe announcement_;
  pid_t process_ = 0;
  nlohmann::json listening_;
};

}  // namespace gonio::test

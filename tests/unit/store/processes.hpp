#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

// Other programs that work on a store, and are killed.

namespace gonio::test {

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Numbers from a child to its parent, and the end of them.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe");
    }
  }
  ~Pipe() {
    close(ends_[0]);
    close_writing();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_writing() {
    if (ends_[1] >= 0) {
      close(ends_[1]);
      ends_[1] = -1;
    }
  }
  void write(std::uint64_t number) const {
    if (::write(ends_[1], &number, sizeof number) != sizeof number) {
      throw std::system_error(errno, std::generic_category(), "write");
    }
  }
  /// @return  whether there was one more: not after the last writer has closed it or died.
  bool read(std::uint64_t& number) const {
    return ::read(ends_[0], &number, sizeof number) == sizeof number;
  }
  void wait_for_end() const {
    for (std::uint64_t number = 0; read(number);) {
    }
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Runs `work` in a child process, which ends with 0, or 1 after an exception.
template <class Work>
pid_t forked(Work&& work) {
  const pid_t child = fork();
  if (child < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (child == 0) {
    try {
      work();
      _exit(0);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "child: %s\n", error.what());
      _exit(1);
    }
  }
  return child;
}

/// @return  its exit status, or 128 + the number of the signal that ended it.
inline int wait_for(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, 0) != child) {
    throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace gonio::test

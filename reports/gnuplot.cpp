#include "reports/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "reports/escape.hpp"

namespace gonio {

namespace {

[[noreturn]] void fail(int cause, const std::string& what) {
  throw std::system_error(cause, std::generic_category(), what);
}

/// A file in memory that no name leads to. Unlike a pipe it never fills, so that nobody waits for
/// anybody; and what is left of it goes with the last process that has it open.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("gonio_chart", MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      fail(errno, "memfd_create");
    }
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Writes the text; a reader begins with it.
  void fill(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t count = ::write(descriptor_, text.data() + done, text.size() - done);
      if (count < 0 && errno != EINTR) {
        fail(errno, "the script of gnuplot");
      }
      done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    lseek(descriptor_, 0, SEEK_SET);
  }

  [[nodiscard]] std::string contents() const {
    std::string text(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t count =
          pread(descriptor_, text.data() + done, text.size() - done, static_cast<off_t>(done));
      if (count < 0 && errno != EINTR) {
        fail(errno, "the output of gnuplot");
      }
      done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    return text;
  }

 private:
  int descriptor_;
};

/// Starts gnuplot with these as its standard files, and nothing of the environment but the path.
pid_t start(const std::array<const MemoryFile*, 3>& files) {
  std::string program = "gnuplot";
  std::string no_settings = "--default-settings";
  std::string from_input = "-";
  const std::array<char*, 4> arguments{program.data(), no_settings.data(), from_input.data(),
                                       nullptr};
  const char* path = std::getenv("PATH");
  std::string path_entry = fmt::format("PATH={}", path != nullptr ? path : "/usr/bin:/bin");
  std::string locale_entry = "LC_ALL=C";
  const std::array<char*, 3> environment{path_entry.data(), locale_entry.data(), nullptr};

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (std::size_t i = 0; i < files.size(); ++i) {
    posix_spawn_file_actions_adddup2(&actions, files.at(i)->descriptor(), static_cast<int>(i));
  }
  pid_t process = 0;
  const int error = posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments.data(),
                                 environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    fail(error, "cannot run gnuplot, which draws the charts");
  }
  return process;
}

/// Waits for its end. @return  its status as waitpid tells it.
int end_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) != process) {
    if (errno != EINTR) {
      fail(errno, "gnuplot");
    }
  }
  return status;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const MemoryFile in;
  const MemoryFile out;
  const MemoryFile err;
  in.fill(script);
  const int status = end_of(start({&in, &out, &err}));
  if (WIFSIGNALED(status)) {
    fail(EIO, fmt::format("gnuplot was ended by signal {}", WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) != 0) {
    fail(EIO, fmt::format("gnuplot ended with status {}: {}", WEXITSTATUS(status),
                          one_line(err.contents())));
  }
  return out.contents();
}

}  // namespace gonio

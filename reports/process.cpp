#include "reports/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
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
  MemoryFile() : descriptor_(memfd_create("gonio_process", MFD_CLOEXEC)) {
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
        fail(errno, "the input of a program");
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
        fail(errno, "the output of a program");
      }
      done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    return text;
  }

 private:
  int descriptor_;
};

std::string search_path() {
  const char* path = std::getenv("PATH");
  return path != nullptr ? path : "/usr/bin:/bin";
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) {
    result.push_back(text.data());
  }
  result.push_back(nullptr);
  return result;
}

/// Starts a program with these as its standard files.
pid_t start(const Command& command, const std::array<const MemoryFile*, 3>& files) {
  std::vector<std::string> arguments = command.arguments;
  std::vector<std::string> environment = command.environment;
  environment.push_back(fmt::format("PATH={}", search_path()));
  environment.emplace_back("LC_ALL=C");

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (std::size_t i = 0; i < files.size(); ++i) {
    posix_spawn_file_actions_adddup2(&actions, files.at(i)->descriptor(), static_cast<int>(i));
  }
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments.front().c_str(), &actions, nullptr,
                                 pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    fail(error, fmt::format("cannot run {}, {}", arguments.front(), command.purpose));
  }
  return process;
}

/// Waits for its end. @return  its status as waitpid tells it.
int end_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) != process) {
    if (errno != EINTR) {
      fail(errno, "waitpid");
    }
  }
  return status;
}

}  // namespace

std::string run_to_end(const Command& command, const std::string& input) {
  const MemoryFile in;
  const MemoryFile out;
  const MemoryFile err;
  in.fill(input);
  const int status = end_of(start(command, {&in, &out, &err}));
  const std::string& name = command.arguments.front();
  if (WIFSIGNALED(status)) {
    fail(EIO, fmt::format("{} was ended by signal {}", name, WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) != 0) {
    fail(EIO, fmt::format("{} ended with status {}: {}", name, WEXITSTATUS(status),
                          one_line(err.contents())));
  }
  return out.contents();
}

std::string first_on_path(const std::vector<std::string>& programs) {
  for (const std::string& program : programs) {
    std::istringstream folders(search_path());
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (!folder.empty() && access(fmt::format("{}/{}", folder, program).c_str(), X_OK) == 0) {
        return program;
      }
    }
  }
  return "";
}

}  // namespace gonio

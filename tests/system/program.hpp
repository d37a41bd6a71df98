#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

inline const std::filesystem::path source_tree(GONIO_SOURCE_DIR);

/// What the program left behind.
struct Outcome {
  int status;  ///< of exit, or 128 + the number of the signal that ended it
  std::string out, err;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Arguments, and more of them.
inline std::vector<std::string> with(std::vector<std::string> arguments,
                                     const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// A run of gonio in a folder of its own, without a shell.
class Program {
 public:
  /// @param program  its path, if it is not the one built here.
  explicit Program(std::filesystem::path program = GONIO_PROGRAM) : program_(std::move(program)) {
    for (char** entry = environ; *entry != nullptr; ++entry) {
      if (!std::string(*entry).starts_with("GONIO_DATA=")) {
        environment_.emplace_back(*entry);
      }
    }
  }

  /// The folder it runs in.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  /// Writes a file into that folder. @return  its path.
  std::filesystem::path file(const std::string& name, std::string_view text) const {
    return folder_.file(name, text);
  }
  void set(const std::string& variable, const std::string& value) {
    std::erase_if(environment_,
                  [&](const std::string& entry) { return entry.starts_with(variable + "="); });
    environment_.push_back(variable + "=" + value);
  }

  /// Runs it to its end. Output goes to files, so that no pipe can fill.
  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments) const {
    const TemporaryFolder outputs;
    const auto out = outputs.path() / "out";
    const auto err = outputs.path() / "err";
    const int status = wait(spawn(arguments, [&](posix_spawn_file_actions_t& actions) {
      constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
      posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
    }));
    return {status, contents(out), contents(err)};
  }

  /// Runs it with a file descriptor as its standard output.
  [[nodiscard]] pid_t start(const std::vector<std::string>& arguments, int out) const {
    return spawn(arguments, [&](posix_spawn_file_actions_t& actions) {
      posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    });
  }

  /// @return  the status of a program started, as in Outcome.
  static int wait(pid_t process) {
    int status = 0;
    if (waitpid(process, &status, 0) != process) {
      throw std::system_error(errno, std::generic_category(), "waitpid");
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (std::string& text : texts) {
      result.push_back(text.data());
    }
    result.push_back(nullptr);
    return result;
  }

  template <class Redirect>
  pid_t spawn(std::vector<std::string> arguments, Redirect redirect) const {
    arguments.insert(arguments.begin(), program_.string());
    std::vector<std::string> environment = environment_;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addchdir_np(&actions, folder().c_str());
    redirect(actions);
    pid_t process = 0;
    const int error = posix_spawn(&process, program_.c_str(), &actions, nullptr,
                                  pointers(arguments).data(), pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      throw std::system_error(error, std::generic_category(), program_.string());
    }
    return process;
  }

  std::filesystem::path program_;
  std::vector<std::string> environment_;
  TemporaryFolder folder_;
};

/// A sample file around the text of its `surface:` or `lobes:`, which begins at line 4.
inline std::string sample_text(const std::string& model) {
  return "schema: gonio/sample/1\nid: mine\ntitle: Mine\n" + model;
}

inline std::string glass_sample() {
  return sample_text("surface: {model: smooth, refractive_index: 1.5}\n");
}

}  // namespace gonio::test

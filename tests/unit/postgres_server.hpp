#pragma once

#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

/// A PostgreSQL of its own, on a socket in a temporary folder. It ends with the program at the
/// latest. Its binaries are those of Debian (/usr/lib/postgresql) or in the PATH.
class PostgresServer {
 public:
  /// @throws std::runtime_error  if it does not start, with its log.
  PostgresServer() {
    if (getuid() == 0) {
      become_ = getpwnam("postgres");  // it refuses to run as root
      if (become_ == nullptr) {
        throw std::runtime_error("expected a user postgres: is postgresql installed?");
      }
      std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_all);
      if (chown(folder_.path().c_str(), become_->pw_uid, become_->pw_gid) != 0) {
        throw std::system_error(errno, std::generic_category(), folder_.path().string());
      }
    }
    expect_done(wait(spawn({binary("initdb"), "-D", data(), "-U", "gonio", "--auth=trust",
                            "--encoding=UTF8", "--locale=C", "--no-sync"})));
    start();
  }
  ~PostgresServer() { stop(SIGQUIT); }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// For Store, as the owner of all. @param database  postgres and template1 are there.
  [[nodiscard]] std::string url(const std::string& database = "postgres") const {
    return "postgresql://gonio@/" + database + "?port=5432&host=" + folder_.path().string();
  }

  /// Starts it on the data that are there, and returns when it takes connections.
  void start() {
    process_ = spawn({binary("postgres"), "-D", data(), "-k", folder_.path().string(), "-p", "5432",
                      "-F", "-c", "listen_addresses="});
    // Each try is a process and takes some ms.
    while (wait(spawn({binary("pg_isready"), "-q", "-h", folder_.path().string(), "-p", "5432",
                       "-U", "gonio"})) != 0) {
      if (waitpid(process_, nullptr, WNOHANG) == process_) {
        process_ = 0;
        expect_done(1);
      }
    }
  }

  /// @param signal  SIGINT: in order; SIGQUIT: at once, as if it had crashed.
  void stop(int signal) {
    if (process_ > 0) {
      kill(process_, signal);
      wait(std::exchange(process_, 0));
    }
  }

 private:
  [[nodiscard]] std::string data() const { return (folder_.path() / "data").string(); }
  [[nodiscard]] std::string log() const { return (folder_.path() / "log").string(); }

  /// Of the newest version there is.
  static std::string binary(const std::string& name) {
    std::error_code none;
    std::filesystem::path newest;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", none)) {
      if (std::filesystem::exists(version.path() / "bin" / name, none)) {
        newest = std::max(newest, version.path() / "bin" / name);
      }
    }
    return newest.empty() ? name : newest.string();
  }

  void expect_done(int status) const {
    if (status != 0) {
      std::ifstream in(log(), std::ios::binary);
      throw std::runtime_error("no PostgreSQL: " +
                               std::string(std::istreambuf_iterator<char>(in), {}));
    }
  }

  static int wait(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) != process) {
      if (errno != EINTR) {
        throw std::system_error(errno, std::generic_category(), "waitpid");
      }
    }
    return status;
  }

  /// Between fork and exec only what may be called there.
  [[nodiscard]] pid_t spawn(std::vector<std::string> arguments) const {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) {
      pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    const std::string log_file = log();
    const std::string folder = folder_.path().string();
    const pid_t process = fork();
    if (process == 0) {
      if (become_ != nullptr && (setgroups(0, nullptr) != 0 || setgid(become_->pw_gid) != 0 ||
                                 setuid(become_->pw_uid) != 0)) {
        _exit(126);
      }
      const int out = open(log_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
      if (out < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(out, STDERR_FILENO) < 0 ||
          chdir(folder.c_str()) != 0) {
        _exit(126);
      }
      prctl(PR_SET_PDEATHSIG, SIGQUIT);
      execvp(pointers.front(), pointers.data());
      _exit(127);
    }
    if (process < 0) {
      throw std::system_error(errno, std::generic_category(), "fork");
    }
    return process;
  }

  TemporaryFolder folder_;
  const passwd* become_ = nullptr;
  pid_t process_ = 0;
};

}  // namespace gonio::test

#include "tests/wire/server_process.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace gonio::test {

namespace {

std::filesystem::path process_folder(pid_t id) {
  return std::filesystem::path("/proc") / std::to_string(id);
}

}  // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& arguments, const Setup& setup) {
  std::vector<std::string> all = {"serve",  setup.instrument, "--sample", "black_glass_n1567",
                                  "--tcp",  setup.tcp,        "--format", "json",
                                  "--ideal"};
  const auto add_default = [&](const char* option, const char* value) {
    if (std::find(arguments.begin(), arguments.end(), option) == arguments.end()) {
      all.insert(all.end(), {option, value});
    }
  };
  add_default("--log-file", "log");
  add_default("--stall-timeout", "300 ms");
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (!setup.preload.empty()) {
    program_.set("LD_PRELOAD", setup.preload);
    program_.set("ASAN_OPTIONS", "verify_asan_link_order=0");
  }
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  id_ = program_.start(all, ends[1]);
  close(ends[1]);
  read_announcement(ends[0]);
  close(ends[0]);
}

void ServerProcess::read_announcement(int file) {
  const Deadline deadline(milliseconds(60'000));
  std::string line;
  while (line.find('\n') == std::string::npos) {
    std::array<char, 512> buffer{};
    const ssize_t count =
        is_readable(file, deadline) ? read(file, buffer.data(), buffer.size()) : 0;
    if (count <= 0) {
      throw std::runtime_error("the server does not say where it listens: " + line + log());
    }
    line.append(buffer.data(), std::size_t(count));
  }
  const auto announced = nlohmann::json::parse(line);
  const std::string tcp = announced.at("tcp");
  port_ = static_cast<std::uint16_t>(std::stoi(tcp.substr(tcp.rfind(':') + 1)));
  serial_line_ = announced.value("rtu", "");
}

ServerProcess::~ServerProcess() {
  if (is_alive()) {
    EXPECT_EQ(end(), 0) << log();
  }
  if (is_alive()) {
    kill(id_, SIGKILL);
    Program::wait(id_);
  }
}

bool ServerProcess::is_alive() {
  int status = 0;
  if (id_ > 0 && status_ < 0 && waitpid(id_, &status, WNOHANG) == id_) {
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return id_ > 0 && status_ < 0;
}

std::size_t ServerProcess::open_files() const {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(process_folder(id_) / "fd")) {
    count += entry.path().empty() ? 0 : 1;
  }
  return count;
}

double ServerProcess::processor_s() const {
  const std::string all = contents(process_folder(id_) / "stat");
  std::istringstream fields(all.substr(all.rfind(')') + 1));
  constexpr int before = 11;  // fields between the name and the times
  std::string skipped;
  for (int i = 0; i < before; ++i) {
    fields >> skipped;
  }
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return (user + system) / double(sysconf(_SC_CLK_TCK));
}

double ServerProcess::resident_mib() const {
  std::istringstream fields(contents(process_folder(id_) / "statm"));
  double total = 0.0, resident = 0.0;
  fields >> total >> resident;
  constexpr double mib = 1024.0 * 1024.0;
  return resident * double(sysconf(_SC_PAGESIZE)) / mib;
}

void ServerProcess::limit_open_files(std::size_t most) const {
  rlimit limit{};
  if (prlimit(id_, RLIMIT_NOFILE, nullptr, &limit) != 0) {
    throw std::system_error(errno, std::generic_category(), "prlimit");
  }
  limit.rlim_cur = most;
  if (prlimit(id_, RLIMIT_NOFILE, &limit, nullptr) != 0) {
    throw std::system_error(errno, std::generic_category(), "prlimit");
  }
}

std::string ServerProcess::log() const { return contents(program_.folder() / "log"); }

int ServerProcess::end(int signal) {
  kill(id_, signal);
  (void)becomes_true([this] { return !is_alive(); });
  return status_;
}

}  // namespace gonio::test

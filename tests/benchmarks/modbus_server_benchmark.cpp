// Requests per second of `gonio serve` beside a select server on libmodbus.

#include <netinet/in.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "emulator/instrument/device.hpp"
#include "emulator/protocol/client.hpp"
#include "emulator/protocol/register_map.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/libmodbus_select_server.hpp"
#include "tests/benchmarks/modbus_load.hpp"

namespace gonio::bench {

namespace {

/// The self-description, which lies in holding registers of every gonio.
constexpr std::uint16_t first_register = 40000;

void run_on_cpu(int cpu) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(cpu, &set);
  sched_setaffinity(0, sizeof set, &set);
}

std::uint16_t address_of(const std::string& point) {
  return RegisterMap::standard().find(point)->address;
}

/// A server in a process of its own, on the first processor.
class ServerProcess {
 public:
  ServerProcess() = default;
  virtual ~ServerProcess() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Time of a processor that it has used [s].
  [[nodiscard]] double processor_s() const {
    clockid_t clock = 0;
    timespec now{};
    clock_getcpuclockid(process_, &clock);
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
  }
  /// VmRSS [MiB].
  [[nodiscard]] double resident_mib() const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("VmRSS:")) {
        return std::stod(line.substr(6)) / 1024.0;
      }
    }
    return 0.0;
  }

 protected:
  template <class Child>
  void start(Child child) {
    process_ = fork();
    if (process_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      run_on_cpu(0);
      child();
    }
  }
  std::uint16_t port_ = 0;

 private:
  pid_t process_ = -1;
};

class LibmodbusServer final : public ServerProcess {
 public:
  LibmodbusServer() {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        listen(listener, SOMAXCONN) != 0 ||
        getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::system_error(errno, std::generic_category(), "listen");
    }
    port_ = ntohs(address.sin_port);
    start([=] {
      serve_with_libmodbus(listener, modbus_mapping_new_start_address(
                                         0, 0, 0, 0, unsigned(first_register), 100, 0, 0));
    });
    close(listener);
  }
};

class GonioServer final : public ServerProcess {
 public:
  /// @param speed  of its time, relative to ours.
  explicit GonioServer(const char* speed = "1") {
    std::array<int, 2> out{};
    if (pipe(out.data()) != 0) {
      throw std::system_error(errno, std::generic_category(), "pipe");
    }
    start([&] {
      dup2(out[1], STDOUT_FILENO);
      execl(GONIO_PROGRAM, "gonio", "serve",
            GONIO_SOURCE_DIR "/fixtures/instruments/triangle_gloss.yaml", "--tcp", "127.0.0.1:0",
            "--format", "json", "--log-level", "off", "--place", "tile", "--speed", speed, nullptr);
      _exit(127);
    });
    close(out[1]);
    const std::unique_ptr<FILE, int (*)(FILE*)> in(fdopen(out[0], "r"), std::fclose);
    std::array<char, 1024> line{};
    if (std::fgets(line.data(), int(line.size()), in.get()) == nullptr) {
      throw std::runtime_error("gonio serve did not begin");
    }
    const std::string tcp = nlohmann::json::parse(line.data()).at("tcp");
    port_ = static_cast<std::uint16_t>(std::stoi(tcp.substr(tcp.rfind(':') + 1)));
  }
};

/// The client runs on the other processor, if there is one.
void requests_per_second(benchmark::State& state, double target) {
  const LibmodbusServer reference;
  const GonioServer subject;
  Load load{
      .address = first_register, .connections = int(state.range(0)), .depth = int(state.range(1))};
  run_on_cpu(1);
  load.port = reference.port();
  LoadClient reference_client(load);
  load.port = subject.port();
  LoadClient subject_client(load);
  const int rounds = load.depth > 1 ? 50 : 10'000;
  std::vector<double> round_s;
  const double reference_began = reference.processor_s();
  const double subject_began = subject.processor_s();
  compare(
      state, speedup_at_least(target), [&] { reference_client.run(rounds); },
      [&] { round_s = subject_client.run(rounds); }, Clock::elapsed);
  state.counters["processor_ratio"] =
      (reference.processor_s() - reference_began) / (subject.processor_s() - subject_began);
  state.counters["p99_ms"] = 1e3 * quantile(round_s, 0.99);
  state.counters["requests_per_s"] =
      double(rounds * load.depth) / state.counters["subject_s"].value;
  state.counters["resident_mib"] = subject.resident_mib();
}
BENCHMARK_CAPTURE(requests_per_second, closed_loop, 1.5)
    ->ArgNames({"connections", "pipelined"})
    ->Args({1, 1})
    ->Args({8, 1})
    ->Args({64, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(requests_per_second, pipelined, 10.0)
    ->ArgNames({"connections", "pipelined"})
    ->Args({1, 10})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Commands the instrument and waits until it is done.
void carry_out(ModbusClient& client, DeviceCommand command) {
  client.write_registers(address_of("command"), {static_cast<std::uint16_t>(command)});
  while (client.read_registers(modbus::Table::holding_registers, address_of("command"), 1)[0] !=
         0) {
    sched_yield();
  }
}

/// How soon the instrument says that it is busy, while it measures without an end.
void command_while_measuring(benchmark::State& state) {
  constexpr double target_ms = 1.0;
  const GonioServer server("1000");
  DeviceUrl url;
  url.host = "127.0.0.1";
  url.port = server.port();
  ModbusClient client(url, std::chrono::seconds(1));
  while (client.read_registers(modbus::Table::input_registers, address_of("state"), 1)[0] ==
         std::uint16_t(DeviceState::warm_up)) {
    sched_yield();
  }
  carry_out(client, DeviceCommand::calibrate);
  client.write_registers(address_of("mode"), {std::uint16_t(MeasuringMode::continuous)});
  client.write_registers(address_of("command"), {std::uint16_t(DeviceCommand::measure)});
  std::vector<double> elapsed_s;
  for ([[maybe_unused]] auto turn : state) {
    const double start = seconds(Clock::elapsed);
    try {
      client.write_registers(address_of("command"), {std::uint16_t(DeviceCommand::measure)});
      state.SkipWithError("a command that is accepted while another runs");
      break;
    } catch (const ModbusExceptionError& error) {
      elapsed_s.push_back(seconds(Clock::elapsed) - start);
    }
  }
  if (!elapsed_s.empty()) {
    state.counters["median_ms"] = 1e3 * median(elapsed_s);
    state.counters["p99_ms"] = 1e3 * quantile(elapsed_s, 0.99);
    state.counters["target_ms"] = target_ms;
  }
}
BENCHMARK(command_while_measuring)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench

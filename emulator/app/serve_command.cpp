#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "emulator/app/command.hpp"
#include "emulator/app/log.hpp"
#include "emulator/app/station_options.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/protocol/server.hpp"

namespace gonio::app {

namespace {

struct ServeArguments {
  StationOptions station;

  std::optional<std::string> tcp;
  std::string idle_timeout = "60 s", stall_timeout = "5 s";
  TcpOptions tcp_options;
  std::optional<std::string> rtu;
  std::string parity = "even";
  RtuOptions rtu_options;

  std::string format = "text";
  LogOptions log;
};

constexpr const char* default_tcp = "127.0.0.1:1502";

/// HOST:PORT; an IPv6 host in brackets.
void parse_tcp(const std::string& text, TcpOptions& options) {
  const std::size_t colon = std::min(text.rfind(':'), text.size());
  std::string_view host = std::string_view(text).substr(0, colon);
  const char* const text_end = text.data() + text.size();
  const auto [port_end, error] =
      std::from_chars(std::min(text.data() + colon + 1, text_end), text_end, options.port);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    host = {};
  }
  if (error != std::errc() || port_end != text_end || host.empty() ||
      host.find_first_of("[]") != std::string_view::npos) {
    throw std::invalid_argument(fmt::format(
        "--tcp: expected HOST:PORT with a port in [0, 65535], an IPv6 host in brackets, found '{}'",
        text));
  }
  options.host = host;
}

std::chrono::milliseconds parse_time(const char* option, const std::string& text) {
  const auto seconds = parse_quantity(text, Dimension::time);
  if (!seconds || !(*seconds > 0.0) || *seconds > 86'400.0) {
    throw std::invalid_argument(fmt::format(
        "{}: expected a time (s, ms, min, h) > 0 and <= 24 h, found '{}'", option, text));
  }
  return std::chrono::milliseconds(std::lround(1e3 * *seconds));
}

/// Tells where it listens, on standard output, before the first request can come.
void announce(const Listening& listening, const ServeArguments& options) {
  if (options.format == "json") {
    nlohmann::ordered_json line = {{"schema", "gonio/listening/1"}};
    if (listening.tcp) {
      line["tcp"] = *listening.tcp;
    }
    if (listening.rtu) {
      line["rtu"] = *listening.rtu;
    }
    print(line.dump() + "\n");
    return;
  }
  if (listening.tcp) {
    print(
        fmt::format("Modbus TCP on {}: gonio read modbus://{}\n", *listening.tcp, *listening.tcp));
  }
  if (listening.rtu) {
    print(fmt::format("Modbus RTU on {}: gonio read modbus-rtu:{}\n", *listening.rtu,
                      *listening.rtu));
  }
}

void log_summary(spdlog::logger& log, const Counters& counters) {
  std::string by_function;
  for (std::size_t code = 0; code < counters.by_function.size(); ++code) {
    if (counters.by_function[code] > 0) {
      by_function += fmt::format("{}{}: {}", by_function.empty() ? "; by function code " : ", ",
                                 code, counters.by_function[code]);
    }
  }
  log.info(
      "served {} requests, {} exceptions, {} connections, {} refused, {} corrupt headers, {} "
      "dropped frames, {} faults on demand{}",
      counters.requests, counters.exceptions, counters.connections, counters.refused_connections,
      counters.corrupt_headers, counters.dropped_rtu_frames, counters.injected_faults, by_function);
}

void run_serve(ServeArguments options, const CommonOptions& common) {
  if (!options.tcp && !options.rtu) {
    options.tcp = default_tcp;
  }
  std::optional<TcpOptions> tcp;
  if (options.tcp) {
    parse_tcp(*options.tcp, options.tcp_options);
    options.tcp_options.idle_timeout = parse_time("--idle-timeout", options.idle_timeout);
    options.tcp_options.stall_timeout = parse_time("--stall-timeout", options.stall_timeout);
    tcp = options.tcp_options;
  }
  std::optional<RtuOptions> rtu;
  if (options.rtu_options.link && options.rtu != "pty") {
    throw std::invalid_argument("--rtu-link: expected only together with --rtu pty");
  }
  if (options.rtu) {
    options.rtu_options.path = *options.rtu;
    options.rtu_options.parity = options.parity == "even"  ? Parity::even
                                 : options.parity == "odd" ? Parity::odd
                                                           : Parity::none;
    rtu = options.rtu_options;
  }
  std::signal(SIGPIPE, SIG_IGN);  // who reads the log may leave
  const auto log = make_log(options.log);
  const auto station = make_station(options.station, common.catalog());
  Server server(station->dispatcher(), *log);
  announce(server.listen(tcp, rtu), options);
  server.run();
  log_summary(*log, station->counters());
}

void add_line_options(CLI::App& command, ServeArguments& options) {
  command.add_option("--tcp", options.tcp,
                     fmt::format("HOST:PORT, port 0 for any; {} without --rtu", default_tcp));
  command
      .add_option("--max-connections", options.tcp_options.max_connections,
                  "Beyond it the one that was idle longest is closed")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command.add_option("--idle-timeout", options.idle_timeout, "After it a connection is closed")
      ->capture_default_str();
  command
      .add_option("--stall-timeout", options.stall_timeout,
                  "Of a request that has begun, and of a reply that is not taken")
      ->capture_default_str();
  command.add_option("--allow", options.tcp_options.allow,
                     "Addresses and networks that may connect; all if not given");
  command.add_option("--rtu", options.rtu, "Serial device, or pty to make a pseudo terminal");
  command.add_option("--rtu-link", options.rtu_options.link,
                     "Link to make to that pseudo terminal");
  command.add_option("--baud", options.rtu_options.baud, "Of the serial line")
      ->check(CLI::IsMember({1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400}))
      ->capture_default_str();
  command.add_option("--parity", options.parity, "Of the serial line")
      ->check(CLI::IsMember({"none", "even", "odd"}))
      ->capture_default_str();
}

}  // namespace

void add_serve_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command =
      program.add_subcommand("serve", "Instruments on Modbus TCP, on a serial line, or on both");
  const auto options = std::make_shared<ServeArguments>();
  add_station_options(*command, options->station);
  add_line_options(*command, *options);
  command->add_option("--format", options->format, "How the places where it listens are printed")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  add_log_options(*command, options->log);
  command->footer(
      "Example: gonio serve triangle_gloss --tcp 127.0.0.1:1502 --place tile\n"
      "         gonio serve triangle_gloss --rtu pty --rtu-link /tmp/glossmeter --ideal\n"
      "         gonio serve my_meter.yaml other.yaml --unit 1 --unit 7 --log-level trace\n"
      "         gonio serve triangle_gloss --fault '{fault: delay, time: 2 s, function: 3}'");
  command->callback([options, &common] { run_serve(*options, common); });
}

}  // namespace gonio::app

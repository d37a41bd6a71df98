#include "tests/conformance/served_device.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "emulator/core/quantity.hpp"
#include "tests/conformance/modbus_port.hpp"
#include "tests/conformance/probed_line.hpp"

namespace gonio::conformance {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

milliseconds duration_of(const char* option, const std::string& text) {
  auto seconds = parse_quantity(text, Dimension::time);
  if (!seconds) {
    seconds = parse_quantity(text, Dimension::number);
  }
  const Range range = Range::closed(0.001, 1e6);
  if (!seconds || !range.contains(*seconds)) {
    throw std::invalid_argument(
        fmt::format("{}: expected a time{}, e.g. 10 s, found '{}'", option, range.text(), text));
  }
  return milliseconds(std::llround(*seconds * 1e3));
}

/// Asks on the terminal. @return  false if nobody answers, or "n".
bool ask_a_person(const std::string& what) {
  std::cerr << what << " Enter when it is done, n to leave it out: " << std::flush;
  std::string answer;
  return std::getline(std::cin, answer) && answer != "n";
}

/// A profile of the suite by its name, or a file.
Profile find_profile(const std::string& text, const ConformanceSuite& suite) {
  const fs::path shipped =
      fs::path(suite.set.mark.file).parent_path() / "profiles" / (text + ".yaml");
  return Profile::load(fs::is_regular_file(shipped) ? shipped : fs::path(text));
}

/// Tries cases on a server. After one that failed it is asked whether it is still there; if not,
/// each case is an error until it is, and at once when that has been tried for long enough.
class JudgedServer {
 public:
  JudgedServer(const DeviceUrl& url, Profile profile, milliseconds timeout)
      : url_(url), profile_(std::move(profile)), line_(probed_line(url, {.reply = timeout})) {
    profile_.unit = static_cast<std::uint8_t>(url.unit);
  }

  ExchangeOutcome run(const YamlNode& when) {
    if (is_suspect_) {
      expect_answer();
    }
    const ExchangeResult result = run_exchange(when, *line_, profile_);
    is_suspect_ = !result.failure.empty();
    return {.failure = result.failure, .skipped = result.skipped};
  }

 private:
  void expect_answer() {
    constexpr std::chrono::seconds most{5};
    const auto begin = std::chrono::steady_clock::now();
    if (searched_ >= most || !answers(*line_, profile_)) {
      searched_ += std::chrono::steady_clock::now() - begin;
      throw DeviceLost(fmt::format("{}: no longer answers a good request", url_.text()));
    }
  }

  DeviceUrl url_;
  Profile profile_;
  std::unique_ptr<ProbedLine> line_;
  bool is_suspect_ = false;
  std::chrono::nanoseconds searched_{};
};

DeviceUnderTest any_server(const DeviceOptions& options, const DeviceUrl& url,
                           const ConformanceSuite& suite) {
  const Profile profile = find_profile(options.profile, suite);
  const auto server =
      std::make_shared<JudgedServer>(url, profile, duration_of("--timeout", options.timeout));
  DeviceUnderTest device{.bench = {}, .title = profile.title, .detail = url.text()};
  device.exchange = [server](const YamlNode& when) { return server->run(when); };
  return device;
}

}  // namespace

bool is_device_url(const std::string& text) {
  return text.starts_with("modbus:") || text.starts_with("modbus-rtu:");
}

DeviceUnderTest served_device(const DeviceOptions& options, const ConformanceSuite& suite) {
  const DeviceUrl url = DeviceUrl::parse(options.device);
  if (!suite.set.standard) {
    return any_server(options, url, suite);
  }
  const auto port = std::make_shared<ModbusPort>(
      options.device,
      ModbusPort::Options{.timeout = duration_of("--timeout", options.timeout),
                          .patience = duration_of("--patience", options.patience),
                          .ask = options.asks ? ModbusPort::Ask(ask_a_person) : nullptr});
  const Identity& identity = port->identity();
  DeviceUnderTest device{.bench = {},
                         .is_spectrum_known = false,
                         .title = fmt::format("{} {}, serial number {}", identity.manufacturer,
                                              identity.model, identity.serial_number),
                         .detail = port->where()};
  const auto standard = std::make_shared<Standard>(*suite.set.standard);
  const auto bench =
      std::make_shared<Bench>(standard.get(), [port, standard]() -> DevicePort& { return *port; });
  device.bench = [bench] { return bench; };
  return device;
}

}  // namespace gonio::conformance

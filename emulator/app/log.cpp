#include "emulator/app/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/formatter.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "emulator/app/command.hpp"

namespace gonio::app {

namespace {

constexpr std::size_t mib = 1024 * 1024;

/// One JSON object a line: {"time":"2026-01-31T12:00:00.123Z","level":"info","message":"..."}.
class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
    using std::chrono::milliseconds;
    const auto since_epoch =
        std::chrono::duration_cast<milliseconds>(message.time.time_since_epoch());
    const auto seconds = std::chrono::system_clock::to_time_t(message.time);
    const auto level = spdlog::level::to_string_view(message.level);
    const nlohmann::ordered_json line = {
        {"time", fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(seconds),
                             since_epoch.count() % 1000)},
        {"level", std::string(level.data(), level.size())},
        {"message", std::string(message.payload.data(), message.payload.size())}};
    fmt::format_to(std::back_inserter(out), "{}\n",
                   line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }
};

spdlog::sink_ptr make_sink(const LogOptions& options) {
  if (!options.file) {
    return std::make_shared<spdlog::sinks::stderr_color_sink_st>();
  }
  try {
    return std::make_shared<spdlog::sinks::rotating_file_sink_st>(
        *options.file, options.max_size_mib * mib, options.max_files);
  } catch (const spdlog::spdlog_ex&) {
    throw std::system_error(errno, std::generic_category(), "cannot write " + *options.file);
  }
}

}  // namespace

void add_log_options(CLI::App& command, LogOptions& options) {
  command.add_option("--log-level", options.level, "trace shows every request")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  command.add_option("--log-format", options.format, "Text, or one JSON object a line")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command.add_option("--log-file", options.file, "Instead of standard error");
  command
      .add_option("--log-size", options.max_size_mib, "MiB of the log file before it is rotated")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--log-files", options.max_files, "Older log files that are kept")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
}

std::shared_ptr<spdlog::logger> make_log(const LogOptions& options) {
  auto log = std::make_shared<spdlog::logger>("gonio", make_sink(options));
  log->set_level(spdlog::level::from_str(options.level));
  log->flush_on(spdlog::level::info);
  if (options.format == "json") {
    log->set_formatter(std::make_unique<JsonFormatter>());
  } else {
    log->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
  }
  return log;
}

}  // namespace gonio::app

#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace spdlog {
class logger;
}

namespace gonio::app {

/// Where a log goes and how it reads.
struct LogOptions {
  std::string level = "info";
  std::string format = "text";
  std::optional<std::string> file = {};  ///< standard error if nothing
  std::size_t max_size_mib = 10;         ///< of the file, then it is rotated
  std::size_t max_files = 5;             ///< kept besides the one that is written
};

void add_log_options(CLI::App& command, LogOptions& options);

/// @throws std::system_error  if the file cannot be opened.
[[nodiscard]] std::shared_ptr<spdlog::logger> make_log(const LogOptions& options);

}  // namespace gonio::app

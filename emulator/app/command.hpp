#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/core/catalog.hpp"
#include "emulator/core/quantity.hpp"

namespace gonio::app {

/// What a program's exit says.
enum ExitStatus { done = 0, does_not_conform = 1, bad_input = 2, environment_failed = 3 };

/// Options that every command has.
struct CommonOptions {
  std::optional<std::string> data_dir;

  [[nodiscard]] Catalog catalog() const { return Catalog::standard_places(data_dir); }
};

/// Each adds its command to the program; the command's work is its callback.
void add_measure_command(CLI::App& program, const CommonOptions& common);
void add_colour_command(CLI::App& program, const CommonOptions& common);
void add_profile_command(CLI::App& program, const CommonOptions& common);
void add_list_command(CLI::App& program, const CommonOptions& common);
void add_glass_command(CLI::App& program, const CommonOptions& common);
/// @param status  becomes what the certificate says.
void add_certify_command(CLI::App& program, const CommonOptions& common, ExitStatus& status);
/// @param status  becomes what is decided of the batch.
void add_qa_command(CLI::App& program, const CommonOptions& common, ExitStatus& status);
void add_acquire_command(CLI::App& program, const CommonOptions& common);
void add_calibrate_command(CLI::App& program, const CommonOptions& common);
void add_validate_command(CLI::App& program, const CommonOptions& common);
void add_scan_command(CLI::App& program, const CommonOptions& common);
/// @param status  tells whether a search converged.
void add_fit_command(CLI::App& program, const CommonOptions& common, ExitStatus& status);
void add_convert_command(CLI::App& program);
void add_serve_command(CLI::App& program, const CommonOptions& common);
void add_registers_command(CLI::App& program);
void add_read_command(CLI::App& program);
void add_trigger_command(CLI::App& program);
void add_watch_command(CLI::App& program);
void add_write_command(CLI::App& program);

/// Refuses what is not a number in that range, NaN too. @param range  not all numbers.
[[nodiscard]] CLI::Validator number_in(const Range& range);

/// `--format text|json|csv`.
void add_format_option(CLI::App& command, std::string& format);

/// Writes to standard output. @throws std::system_error  if that fails, e.g. on a full disk.
void print(std::string_view text);

}  // namespace gonio::app

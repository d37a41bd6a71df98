#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>

#include "emulator/app/command.hpp"
#include "emulator/core/input_error.hpp"
#include "emulator/protocol/client.hpp"

namespace gonio::app {

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
  }
}

CLI::Validator number_in(const Range& range) {
  const std::string expected = "number" + range.text();
  return {[=](const std::string& text) {
            const auto value = parse_quantity(text, Dimension::number);
            return value && range.contains(*value)
                       ? std::string()
                       : fmt::format("expected a {}, found '{}'", expected, text);
          },
          range.text()};
}

void add_format_option(CLI::App& command, std::string& format) {
  command.add_option("--format", format, "How results are printed")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->capture_default_str();
}

namespace {

/// The first word of a command line that names no command.
std::optional<std::string> unknown_command(const CLI::App& program) {
  for (const std::string& word : program.remaining()) {
    if (program.get_subcommands().empty() && !word.starts_with('-')) {
      return word;
    }
  }
  return std::nullopt;
}

std::string command_list(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

int run(int argc, char** argv) {
  CLI::App program{"Virtual gonio-spectrophotometer and glossmeter", "gonio"};
  program.set_version_flag("--version", "gonio " GONIO_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
  program.footer(
      "Example: gonio measure --sample copper_polished --standard iso_2813/2014\n"
      "Exit status: 0 done, 1 does not conform or the instrument says no, 2 bad input, 3 the "
      "environment failed");
  CommonOptions common;
  ExitStatus status = done;
  program.add_option("--data", common.data_dir,
                     "Folder with standards and fixtures, searched first");
  add_measure_command(program, common);
  add_colour_command(program, common);
  add_profile_command(program, common);
  add_list_command(program, common);
  add_glass_command(program, common);
  add_certify_command(program, common, status);
  add_qa_command(program, common, status);
  add_scan_command(program, common);
  add_acquire_command(program, common);
  add_calibrate_command(program, common);
  add_fit_command(program, common, status);
  add_validate_command(program, common);
  add_convert_command(program);
  add_serve_command(program, common);
  add_registers_command(program);
  add_read_command(program);
  add_trigger_command(program);
  add_watch_command(program);
  add_write_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const auto word = unknown_command(program)) {
      throw std::invalid_argument(
          fmt::format("expected one of the commands {}, found '{}'", command_list(program), *word));
    }
    return program.exit(error) == 0 ? done : bad_input;
  }
  return status;
}

}  // namespace

}  // namespace gonio::app

int main(int argc, char** argv) {
  using namespace gonio::app;
  try {
    return run(argc, argv);
  } catch (const gonio::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "gonio: {}\n", error.what());
    return bad_input;
  } catch (const gonio::DeviceRefusal& error) {
    fmt::print(stderr, "gonio: {}\n", error.what());
    return does_not_conform;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gonio: {}\n", error.what());
    return environment_failed;
  }
}

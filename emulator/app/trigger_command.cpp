#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>

#include "emulator/app/command.hpp"
#include "emulator/app/device_report.hpp"
#include "emulator/app/device_session.hpp"

namespace gonio::app {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

struct TriggerArguments {
  DeviceOptions device;
  std::string command;
  std::string wait = "60 s";
};

/// The device's words for what it can be told to do.
std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Symbol& symbol : known_point("command").symbols) {
    if (symbol.name != "none") {
      names.push_back(symbol.name);
    }
  }
  return names;
}

/// Waits until a command is over.
/// @throws DeviceRefusal  if it fails, or takes longer.
void await(ModbusClient& client, const std::string& name, const GivenCommand& command,
           steady_clock::time_point deadline) {
  const std::string what = fmt::format("{}: {}", client.url().text(), name);
  const std::optional<DeviceView> view = command.outcome(deadline);
  if (!view) {
    throw DeviceRefusal(fmt::format("{}: still running; see `gonio watch`", what));
  }
  if (view->text("command_state") == "failed") {
    throw DeviceRefusal(fmt::format("{}: {}: {}", what, view->text("command_error"),
                                    view->meaning("command_error")));
  }
}

void run_trigger(const TriggerArguments& options) {
  const auto wait = parse_duration("--wait", options.wait, Range::closed(0.0, 86'400.0));
  ModbusClient client = options.device.connect();
  const auto deadline = steady_clock::now() + wait;
  const GivenCommand command(client, options.command, wait);
  if (wait == milliseconds(0)) {
    print(fmt::format("{}: accepted\n", options.command));
    return;
  }
  await(client, options.command, command, deadline);
  if (options.command != "measure") {
    print(fmt::format("{}: done\n", options.command));
    return;
  }
  const DeviceView view = retry_while_busy(busy_patience, [&] {
    return DeviceView(client, points_of_blocks({"status", "readings", "statistics", "channels"}));
  });
  print(readings_text(view, isatty(STDOUT_FILENO) != 0));
}

}  // namespace

void add_trigger_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("trigger", "Have a glossmeter on Modbus measure, calibrate and so on");
  const auto options = std::make_shared<TriggerArguments>();
  add_device_options(*command, options->device);
  command->add_option("command", options->command, "What it is to do")
      ->required()
      ->check(CLI::IsMember(command_names()));
  command->add_option("--wait", options->wait, "Longest wait for it to be done; 0 s: do not wait")
      ->capture_default_str();
  command->footer(
      "Example: gonio trigger modbus://127.0.0.1:1502 calibrate\n"
      "         gonio trigger modbus://127.0.0.1:1502 measure --wait 10");
  command->callback([options] { run_trigger(*options); });
}

}  // namespace gonio::app

#include "emulator/protocol/device_dialogue.hpp"

#include <fmt/format.h>

#include <thread>
#include <utility>

#include "emulator/protocol/point_text.hpp"

namespace gonio {

void pause_between_questions() { std::this_thread::sleep_for(std::chrono::milliseconds(50)); }

GivenCommand::GivenCommand(ModbusClient& client, std::string name,
                           std::chrono::milliseconds patience)
    : client_(client), name_(std::move(name)) {
  const Point& command = known_point("command");
  const std::vector<std::uint16_t> code = parse_value(command, name_);
  before_ = retry_while_busy(patience, [&] { return read(); }).number("command_sequence");
  retry_while_busy(patience, [&] { client_.write_registers(command.address, code); });
}

DeviceView GivenCommand::read() const {
  return {client_,
          {&known_point("command_sequence"), &known_point("last_command"),
           &known_point("command_state"), &known_point("command_error")}};
}

std::optional<DeviceView> GivenCommand::outcome(
    std::chrono::steady_clock::time_point deadline) const {
  for (;;) {
    DeviceView view = retry_while_busy(busy_patience, [&] { return read(); });
    const bool is_ours = view.number("command_sequence") != before_;
    if (is_ours && view.text("last_command") != name_) {
      throw DeviceRefusal(
          fmt::format("{}: {}: expected to hear what became of it, found that someone else gave "
                      "the command {} meanwhile",
                      client_.url().text(), name_, view.text("last_command")));
    }
    const std::string state = view.text("command_state");
    if (is_ours && (state == "done" || state == "failed")) {
      return view;
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      return std::nullopt;
    }
    pause_between_questions();
  }
}

}  // namespace gonio

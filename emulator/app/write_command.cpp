#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "emulator/app/command.hpp"
#include "emulator/app/device_session.hpp"
#include "emulator/protocol/device_view.hpp"
#include "emulator/protocol/point_text.hpp"

namespace gonio::app {

namespace {

constexpr std::size_t most_registers = 123;  // of one request

struct WriteArguments {
  DeviceOptions device;
  std::vector<std::string> assignments;
};

/// POINT=VALUE of the command line.
struct Assignment {
  PointName name;
  std::vector<std::uint16_t> registers;
};

/// Values of adjoining addresses.
struct Request {
  modbus::Table table;
  std::size_t address;
  std::vector<std::uint16_t> registers;
};

Assignment parse_assignment(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw std::invalid_argument(fmt::format("expected POINT=VALUE, found '{}'", text));
  }
  const PointName name = PointName::parse(text.substr(0, equals));
  if (!name.point->is_writable) {
    throw std::invalid_argument(fmt::format(
        "{}: expected a point that can be written, found one that is read only", name.text));
  }
  return {name, parse_value(*name.point, text.substr(equals + 1))};
}

/// In the order of addresses; what adjoins goes together.
std::vector<Request> plan(ModbusClient& client, const std::vector<Assignment>& assignments) {
  std::vector<std::pair<const Point*, const Assignment*>> points;
  points.reserve(assignments.size());
  for (const Assignment& assignment : assignments) {
    points.emplace_back(&assignment.name.resolve(client), &assignment);
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.first->address < b.first->address; });
  std::vector<Request> requests;
  const Point* before = nullptr;
  for (const auto& [point, assignment] : points) {
    if (point == before) {
      throw std::invalid_argument(
          fmt::format("{}: expected each point once, found it twice", point->id));
    }
    const bool adjoins =
        before != nullptr && requests.back().table == modbus::Table::holding_registers &&
        point->address == before->last_address() + 1 &&
        requests.back().registers.size() + assignment->registers.size() <= most_registers;
    if (!adjoins) {
      requests.push_back({.table = point->table, .address = point->address, .registers = {}});
    }
    auto& registers = requests.back().registers;
    registers.insert(registers.end(), assignment->registers.begin(), assignment->registers.end());
    before = point;
  }
  return requests;
}

void run_write(const WriteArguments& options) {
  std::vector<Assignment> assignments;
  for (const std::string& text : options.assignments) {
    assignments.push_back(parse_assignment(text));
  }
  ModbusClient client = options.device.connect();
  for (const Request& request : plan(client, assignments)) {
    const auto address = static_cast<std::uint16_t>(request.address);
    retry_while_busy(busy_patience, [&] {
      request.table == modbus::Table::coils
          ? client.write_coil(address, request.registers.front() != 0)
          : client.write_registers(address, request.registers);
    });
  }
}

}  // namespace

void add_write_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("write", "Change settings of a glossmeter on Modbus");
  const auto options = std::make_shared<WriteArguments>();
  add_device_options(*command, options->device);
  command
      ->add_option("assignments", options->assignments,
                   "POINT=VALUE: points of the register map; symbols by name, bits with + "
                   "between them; adjoining points are written together, all or none")
      ->required();
  command->footer(
      "Example: gonio write modbus://127.0.0.1:1502 mode=statistics statistics_readings=10\n"
      "         gonio write modbus://127.0.0.1:1502 mode=pass_fail lower_limit_60=80 "
      "measured_channels=channel_1+channel_2");
  command->callback([options] { run_write(*options); });
}

}  // namespace gonio::app

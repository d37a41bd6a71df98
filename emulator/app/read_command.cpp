#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "emulator/app/command.hpp"
#include "emulator/app/device_report.hpp"
#include "emulator/app/device_session.hpp"
#include "emulator/core/csv_cell.hpp"

namespace gonio::app {

namespace {

struct ReadArguments {
  DeviceOptions device;
  std::vector<std::string> points;
  std::string format = "text";
};

std::string points_json(const std::string& url, const std::vector<const Point*>& points,
                        const DeviceView& view) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const Point* point : points) {
    const bool is_number = point->type != PointType::text && point->symbols.empty();
    list.push_back({{"id", point->id},
                    {"value", is_number ? json_number(view.number(point->id))
                                        : ordered_json(view.text(point->id))},
                    {"unit", point->unit},
                    {"meaning", point->meaning}});
  }
  return ordered_json{{"schema", "gonio/points/1"}, {"url", url}, {"points", list}}.dump(
             1, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

std::string points_table(const std::vector<const Point*>& points, const DeviceView& view,
                         bool is_csv) {
  std::string text = is_csv ? "id,value,unit\n" : "";
  std::size_t width = 0;
  for (const Point* point : points) {
    width = std::max(width, point->id.size());
  }
  for (const Point* point : points) {
    const std::string value = view.text(point->id);
    const bool has_unit = !point->unit.empty() && std::isfinite(view.number(point->id));
    text += is_csv ? fmt::format("{},{},{}\n", point->id, csv_cell(value == "-" ? "" : value),
                                 csv_cell(point->unit))
                   : fmt::format("{:<{}}  {}{}{}\n", point->id, width, value, has_unit ? " " : "",
                                 has_unit ? point->unit : "");
  }
  return text;
}

std::string read_points(ModbusClient& client, const std::vector<PointName>& names,
                        const std::string& format) {
  std::vector<const Point*> points;
  points.reserve(names.size());
  for (const PointName& name : names) {
    points.push_back(&name.resolve(client));
  }
  const DeviceView view(client, points);
  return format == "json" ? points_json(client.url().text(), points, view)
                          : points_table(points, view, format == "csv");
}

void run_read(const ReadArguments& options) {
  std::vector<PointName> names;
  for (const std::string& point : options.points) {
    names.push_back(PointName::parse(point));
  }
  ModbusClient client = options.device.connect();
  print(retry_while_busy(busy_patience, [&] {
    if (!names.empty()) {
      return read_points(client, names, options.format);
    }
    const DeviceReport report = DeviceReport::read(client);
    return options.format == "json"  ? device_json(report)
           : options.format == "csv" ? device_csv(report)
                                     : device_text(report, isatty(STDOUT_FILENO) != 0);
  }));
}

}  // namespace

void add_read_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("read", "What a glossmeter on Modbus shows");
  const auto options = std::make_shared<ReadArguments>();
  add_device_options(*command, options->device);
  command->add_option("--points", options->points,
                      "Only these points of the register map, e.g. gloss_60 temperature");
  add_format_option(*command, options->format);
  command->footer(
      "Example: gonio read modbus://127.0.0.1:1502\n"
      "         gonio read modbus-rtu:/dev/ttyUSB0 --points gloss_60 temperature --format csv");
  command->callback([options] { run_read(*options); });
}

}  // namespace gonio::app

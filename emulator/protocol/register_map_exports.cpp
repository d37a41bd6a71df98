#include "emulator/protocol/register_map_exports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "emulator/protocol/register_map_documents.hpp"

namespace gonio {

namespace {

using modbus::Table;

/// Text in double quotes, as YAML and TOML know them.
std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

std::string openmodbus_table(Table table) {
  switch (table) {
    case Table::coils:
      return "coil";
    case Table::discrete_inputs:
      return "discrete_input";
    case Table::holding_registers:
      return "holding";
    case Table::input_registers:
      return "input";
  }
  return "";
}

std::string openmodbus_type(PointType type) {
  return type == PointType::boolean ? "bool" : type == PointType::text ? "string" : name_of(type);
}

std::string openmodbus_register(const Point& point) {
  std::string text = fmt::format(
      "  \"{}\":\n    name: {}\n    display_name: {}\n    type: {}\n    length: {}\n    unit: {}\n"
      "    register_type: {}\n    read_access: true\n    write_access: {}\n",
      point.address, point.id, in_quotes(point.meaning), openmodbus_type(point.type),
      point.registers, in_quotes(point.unit), openmodbus_table(point.table), point.is_writable);
  if (point.is_word_swapped) {
    text += "    byte_order: CDAB\n";
  }
  if (point.scale != 1.0) {
    text += fmt::format("    scaling: {{factor: {}, offset: 0}}\n", point.scale);
  }
  if (point.is_bit_field) {
    text += "    bits:\n";
    for (const Symbol& bit : point.symbols) {
      text += fmt::format("      \"{}\": {{descriptive_name: {}, vendor_name: {}}}\n", bit.value,
                          bit.name, in_quotes(bit.meaning));
    }
  } else if (!point.symbols.empty()) {
    text += fmt::format("    notes: {}\n", in_quotes(symbol_list(point)));
  }
  return text;
}

std::vector<Point> monitored_points(const RegisterMap& map) {
  std::vector<Point> points;
  for (const Block& block : map.blocks) {
    if (block.is_monitored) {
      points.insert(points.end(), block.points.begin(), block.points.end());
    }
  }
  return points;
}

/// Points that one request can read: of one table and one word order, without a hole.
using Request = std::vector<Point>;

std::vector<Request> requests(const std::vector<Point>& points) {
  std::vector<Request> result;
  for (const Point& point : points) {
    const bool goes_on =
        !result.empty() && result.back().back().table == point.table &&
        result.back().back().is_word_swapped == point.is_word_swapped &&
        result.back().back().last_address() + 1 == point.address &&
        point.last_address() - result.back().front().address < int{modbus::max_read_registers};
    if (!goes_on) {
      result.emplace_back();
    }
    result.back().push_back(point);
  }
  return result;
}

std::string telegraf_field(const Point& point) {
  std::string text = fmt::format("      {{address={}, name={}", point.address, in_quotes(point.id));
  if (point.type == PointType::text) {
    text += fmt::format(", type=\"STRING\", length={}", point.registers);
  } else if (point.type != PointType::boolean) {
    std::string type = name_of(point.type);
    std::ranges::transform(type, type.begin(), [](unsigned char c) { return std::toupper(c); });
    text += fmt::format(", type={}", in_quotes(type));
  }
  if (point.scale != 1.0) {
    text += fmt::format(", scale={}", point.scale);
  }
  return text + "},\n";
}

std::string telegraf_table(Table table) {
  return table == Table::discrete_inputs ? "discrete" : openmodbus_table(table);
}

std::string sensor(const Point& point) {
  std::string text = fmt::format(
      "      - {{name: {}, unique_id: gonio_{}, slave: 1, address: {}, input_type: {}",
      in_quotes("gonio " + point.id), point.id, point.address, openmodbus_table(point.table));
  if (point.type == PointType::boolean) {
    return text + "}\n";
  }
  text += fmt::format(", data_type: {}", openmodbus_type(point.type));
  if (point.type == PointType::text) {
    text += fmt::format(", count: {}", point.registers);
  }
  if (point.is_word_swapped) {
    text += ", swap: word";
  }
  if (point.scale != 1.0) {
    text += fmt::format(", scale: {}", point.scale);
  }
  if (point.type == PointType::float32 || point.scale != 1.0) {
    text += fmt::format(", precision: {}", point.type == PointType::float32 ? 3 : 2);
  }
  if (point.channel && point.type == PointType::int16) {
    text += ", nan_value: 0x8000";
  }
  if (!point.unit.empty()) {
    text += fmt::format(", unit_of_measurement: {}",
                        in_quotes(point.unit == "degC" ? "\u00B0C" : point.unit));
  }
  return text + "}\n";
}

}  // namespace

std::string openmodbus_yaml(const RegisterMap& map) {
  std::string text = fmt::format(
      "version: \"0.3.0\"\ndevice:\n  id: gonio_glossmeter\n  manufacturer: gonio\n"
      "  model: virtual glossmeter\n  description: {}\n  protocol: modbus_tcp\n"
      "  profile_version: \"{}.0.0\"\n  default_byte_order: ABCD\n"
      "  default_register_type: input\nregisters:\n",
      in_quotes(map.title), map.version);
  for (const Block& block : map.blocks) {
    for (const Point& point : block.points) {
      text += openmodbus_register(point);
    }
  }
  return text;
}

std::string telegraf_toml(const RegisterMap& map) {
  std::string text =
      "[[inputs.modbus]]\n  name = \"gonio\"\n  controller = \"tcp://127.0.0.1:502\"\n"
      "  timeout = \"1s\"\n  configuration_type = \"request\"\n";
  for (const Request& request : requests(monitored_points(map))) {
    text += fmt::format(
        "\n  [[inputs.modbus.request]]\n    slave_id = 1\n    byte_order = \"{}\"\n"
        "    register = \"{}\"\n    measurement = \"glossmeter\"\n    fields = [\n",
        request.front().is_word_swapped ? "CDAB" : "ABCD", telegraf_table(request.front().table));
    for (const Point& point : request) {
      text += telegraf_field(point);
    }
    text += "    ]\n";
  }
  return text;
}

std::string home_assistant_yaml(const RegisterMap& map) {
  std::string sensors, bits;
  for (const Point& point : monitored_points(map)) {
    (point.type == PointType::boolean ? bits : sensors) += sensor(point);
  }
  return "modbus:\n  - name: gonio\n    type: tcp\n    host: 127.0.0.1\n    port: 502\n"
         "    sensors:\n" +
         sensors + "    binary_sensors:\n" + bits;
}

}  // namespace gonio

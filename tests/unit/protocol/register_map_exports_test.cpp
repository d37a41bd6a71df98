#include "emulator/protocol/register_map_exports.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/protocol/register_map_documents.hpp"
#include "tests/unit/protocol/bench_instrument.hpp"

// Reads an instrument as the users of each file would: by what the file says, and nothing else.

namespace gonio {
namespace {

using modbus::Table;
using test::BenchInstrument;

/// A value as a file describes it.
struct Field {
  Table table = Table::input_registers;
  int address = 0;
  std::string type = {};  // lower case: int16, uint16, int32, uint32, float32, text, boolean
  bool is_swapped = false;
  double scale = 1.0;
  int registers = 1;
};
using Fields = std::map<std::string, Field>;

Field with_size(Field field) {
  if (field.type.ends_with("32")) {
    field.registers = 2;
  }
  return field;
}

double decode(const Field& field, const std::vector<std::uint16_t>& words) {
  if (field.registers == 1) {
    return field.scale * (field.type == "int16" ? double(std::int16_t(words[0])) : words[0]);
  }
  const std::uint32_t high = words[field.is_swapped ? 1 : 0], low = words[field.is_swapped ? 0 : 1];
  const std::uint32_t word = high << 16U | low;
  return field.type == "float32" ? double(std::bit_cast<float>(word))
         : field.type == "int32" ? field.scale * std::int32_t(word)
                                 : field.scale * word;
}

double value(BenchInstrument& bench, const Field& field) {
  return decode(field, bench.words(field.table, field.address, field.registers));
}

std::string text(BenchInstrument& bench, const Field& field) {
  std::string result;
  for (const std::uint16_t word : bench.words(field.table, field.address, field.registers)) {
    result += {static_cast<char>(word >> 8U), static_cast<char>(word & 0xFFU)};
  }
  return result.substr(0, result.find('\0'));
}

/// An instrument that has measured.
void measure(BenchInstrument& bench) {
  bench.calibrate();
  bench.set("mode", 1);
  bench.set("command", 1);
  bench.device().advance(90.0);
}

/// What monitoring systems have to show of it, from the device itself.
std::map<std::string, double> monitored(const Device& device) {
  const Device::Status& status = device.status();
  std::map<std::string, double> values{{"state", double(status.state)},
                                       {"active_mode", double(device.settings().mode)},
                                       {"alarms", status.alarms},
                                       {"sequence", status.sequence},
                                       {"command_sequence", status.command.sequence},
                                       {"uptime", std::floor(device.uptime_s())},
                                       {"temperature", device.temperature_c()},
                                       {"alarm_restarted", 1},
                                       {"ready", 1},
                                       {"result_valid", 1},
                                       {"busy", 0}};
  for (std::size_t i = 0; i < status.channels.size(); ++i) {
    const std::string n = fmt::format("_{}", i + 1);
    const ChannelStatus& channel = status.channels[i];
    values["gloss" + n] = channel.reading.gloss_gu;
    values["gloss_tenths" + n] = std::round(channel.reading.gloss_gu * 10.0) * 0.1;
    values["statistics_n" + n] = channel.statistics.n;
    values["mean" + n] = channel.statistics.mean;
    values["maximum" + n] = channel.statistics.maximum;
    values["calibration_deviation" + n] = channel.calibration_deviation_gu;
  }
  return values;
}

/// The same, and what is only in the files of the whole map.
std::map<std::string, double> all(const Device& device) {
  std::map<std::string, double> values = monitored(device);
  values["test_float"] = -123.45;
  values["test_float_cdab"] = -123.45;
  values["test_int16"] = -12345;
  values["test_int32"] = -123456789;
  values["run_measure"] = 0;
  for (std::size_t i = 0; i < device.channels().size(); ++i) {
    const std::string n = fmt::format("_{}", i + 1);
    values["gloss_cdab" + n] = values.at("gloss" + n);
    values["gloss_model_gloss" + n] = values.at("gloss_tenths" + n);
    values["tile" + n] = device.settings().channels[i].tile_gu;
    values["angle_tenths" + n] = device.channels()[i].theta_i.degrees();
  }
  return values;
}

void expect_values(const Fields& fields, const std::map<std::string, double>& expected,
                   BenchInstrument& bench) {
  for (const auto& [id, number] : expected) {
    ASSERT_TRUE(fields.contains(id)) << id;
    // Integers and their tenths are exact but for the product; floats are rounded to float32.
    const bool is_float = fields.at(id).type == "float32";
    EXPECT_DOUBLE_EQ(value(bench, fields.at(id)), is_float ? float(number) : number) << id;
  }
}

TEST(RegisterCsv, ReadsTheValuesOfTheDevice) {
  Fields fields;
  std::istringstream lines(register_csv(RegisterMap::standard()));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "address,number,table,id,type,registers,word_order,scale,unit,access,block,simulation,"
            "symbols,meaning");
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; cells.size() < 8 && std::getline(in, cell, ',');) {
      cells.push_back(cell);
    }
    static const std::map<std::string, Table> tables{
        {"coils", Table::coils},
        {"discrete_inputs", Table::discrete_inputs},
        {"holding_registers", Table::holding_registers},
        {"input_registers", Table::input_registers}};
    fields[cells.at(3)] = {tables.at(cells[2]), std::stoi(cells[0]), cells[4],
                           cells[6] == "CDAB",  std::stod(cells[7]), std::stoi(cells[5])};
  }
  BenchInstrument bench;
  measure(bench);
  expect_values(fields, all(bench.device()), bench);
  EXPECT_EQ(text(bench, fields.at("serial_number")), "SN-0042");
}

Field openmodbus_field(int address, const YamlNode& node) {
  static const std::map<std::string, Table> tables{{"coil", Table::coils},
                                                   {"discrete_input", Table::discrete_inputs},
                                                   {"holding", Table::holding_registers},
                                                   {"input", Table::input_registers}};
  return node.read_map([&](YamlMap& map) {
    map.ignore_others();
    Field field{.table = tables.at(map.required("register_type").text()), .address = address};
    field.type = map.required("type").choice(
        {"bool", "string", "int16", "uint16", "int32", "uint32", "float32"});
    field.registers = map.required("length").integer(1, 125);
    field.is_swapped = map.has("byte_order") && map.required("byte_order").text() == "CDAB";
    if (const auto scaling = map.optional("scaling")) {
      field.scale = scaling->read_map([](YamlMap& pair) {
        EXPECT_EQ(pair.required("offset").number(), 0.0);
        return pair.required("factor").number();
      });
    }
    return field;
  });
}

TEST(OpenModbusProfile, ReadsTheValuesOfTheDevice) {
  Fields fields;
  YamlNode::parse(openmodbus_yaml(RegisterMap::standard()), "openmodbus.yaml")
      .read_map([&](YamlMap& file) {
        EXPECT_EQ(file.required("version").text(), "0.3.0");
        file.required("device").read_map([](YamlMap& device) {
          EXPECT_EQ(device.required("default_byte_order").text(), "ABCD");
          device.ignore_others();
          return 0;
        });
        file.required("registers")
            .for_each_entry([&](const std::string& key, const YamlNode& node) {
              const std::string name = node.read_map([](YamlMap& map) {
                map.ignore_others();
                return map.required("name").id();
              });
              fields[name] = openmodbus_field(std::stoi(key), node);
            });
        return 0;
      });
  BenchInstrument bench;
  measure(bench);
  expect_values(fields, all(bench.device()), bench);
  EXPECT_EQ(text(bench, fields.at("serial_number")), "SN-0042");
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// What stands after `key` up to the next comma, brace or end of line, without quotes.
std::string toml_value(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(key);
  if (at == std::string::npos) {
    return "";
  }
  const std::size_t begin = at + key.size();
  std::string value = line.substr(begin, line.find_first_of(",}", begin) - begin);
  std::erase(value, '"');
  return value;
}

/// What the requests of the file ask for. One request is one read: addresses without a hole.
Fields telegraf_fields(const std::string& toml) {
  Fields fields;
  Field common;
  int first = -1, next = -1;
  std::istringstream lines(toml);
  for (std::string line; std::getline(lines, line);) {
    if (const std::string order = toml_value(line, "byte_order = "); !order.empty()) {
      common.is_swapped = order == "CDAB";
      next = -1;
    } else if (const std::string table = toml_value(line, "register = "); !table.empty()) {
      common.table = table == "input" ? Table::input_registers : Table::discrete_inputs;
    } else if (const std::string address = toml_value(line, "{address="); !address.empty()) {
      Field field = common;
      field.address = std::stoi(address);
      field.type = lower(toml_value(line, "type="));
      const std::string scale = toml_value(line, "scale=");
      field.scale = scale.empty() ? 1.0 : std::stod(scale);
      field = with_size(field);
      first = next < 0 ? field.address : first;
      EXPECT_TRUE(next < 0 || field.address == next) << line;
      next = field.address + field.registers;
      EXPECT_LE(next - first, 125) << line;
      fields[toml_value(line, "name=")] = field;
    }
  }
  return fields;
}

TEST(TelegrafFile, ReadsTheValuesOfTheDevice) {
  BenchInstrument bench;
  measure(bench);
  expect_values(telegraf_fields(telegraf_toml(RegisterMap::standard())), monitored(bench.device()),
                bench);
}

TEST(TelegrafFile, AsksForTheWholeSnapshotInOneRequest) {
  const std::string toml = telegraf_toml(RegisterMap::standard());
  const std::size_t first = toml.find("\"status\""), last = toml.find("\"range_3\"");
  ASSERT_NE(first, std::string::npos);
  EXPECT_GT(toml.find("inputs.modbus.request", first), last);
}

Field home_assistant_field(YamlMap& map) {
  static const std::map<std::string, Table> tables{{"discrete_input", Table::discrete_inputs},
                                                   {"holding", Table::holding_registers},
                                                   {"input", Table::input_registers}};
  map.ignore_others();
  Field field{.table = tables.at(map.required("input_type").text()),
              .address = map.required("address").integer(0, 65535)};
  if (const auto type = map.optional("data_type")) {
    field.type = type->choice({"int16", "uint16", "int32", "uint32", "float32"});
  }
  field.is_swapped = map.has("swap") && map.required("swap").text() == "word";
  if (const auto scale = map.optional("scale")) {
    field.scale = scale->number();
  }
  return with_size(field);
}

Fields home_assistant_fields(const std::string& yaml) {
  Fields fields;
  const YamlNode file = YamlNode::parse(yaml, "home_assistant.yaml");
  file.read_map([&](YamlMap& top) {
    top.required("modbus").list().at(0).read_map([&](YamlMap& hub) {
      hub.ignore_others();
      EXPECT_EQ(hub.required("type").text(), "tcp");
      for (const char* key : {"sensors", "binary_sensors"}) {
        for (const YamlNode& node : hub.required(key).list()) {
          node.read_map([&](YamlMap& sensor) {
            const std::string id = sensor.required("unique_id").id();
            fields[id.substr(std::string("gonio_").size())] = home_assistant_field(sensor);
            return 0;
          });
        }
      }
      return 0;
    });
    return 0;
  });
  return fields;
}

TEST(HomeAssistantFile, ReadsTheValuesOfTheDevice) {
  BenchInstrument bench;
  measure(bench);
  expect_values(home_assistant_fields(home_assistant_yaml(RegisterMap::standard())),
                monitored(bench.device()), bench);
}

/// The standard map polls neither text nor the low word first; another might.
TEST(RegisterMapExports, TellWordOrderAndTextToo) {
  const RegisterMap map = read_register_map(YamlNode::parse(
      "schema: gonio/register_map/1\nversion: 1\ntitle: Mine\nblocks:\n"
      "  - {id: b, title: B, table: input_registers, address: 0, monitored: true, points: [\n"
      "      {id: f, type: float32, word_order: CDAB, meaning: F},\n"
      "      {id: t, type: text, registers: 3, meaning: \"say \\\"T\\\"\"}]}\n",
      "mine.yaml"));
  using testing::HasSubstr;
  EXPECT_THAT(telegraf_toml(map), HasSubstr("byte_order = \"CDAB\""));
  EXPECT_THAT(telegraf_toml(map), HasSubstr("{address=2, name=\"t\", type=\"STRING\", length=3}"));
  EXPECT_THAT(home_assistant_yaml(map), HasSubstr("data_type: float32, swap: word"));
  EXPECT_THAT(home_assistant_yaml(map), HasSubstr("data_type: string, count: 3"));
  EXPECT_THAT(openmodbus_yaml(map), HasSubstr("display_name: \"say \\\"T\\\"\""));
}

}  // namespace
}  // namespace gonio

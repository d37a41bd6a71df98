#include "emulator/protocol/register_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "emulator/core/quantity.hpp"

namespace gonio {

// In a file that CMake makes from register_map.yaml.
extern const char* const register_map_text;

namespace {

using modbus::Table;

constexpr int highest_address = 65535;
constexpr int channels = 3;
constexpr int longest_text = modbus::max_write_registers;  // what one request can write
// The last address that a reference number of five digits can tell.
constexpr int last_of_five_digits = 9998;

constexpr std::array<std::pair<const char*, Table>, 4> tables{
    {{"coils", Table::coils},
     {"discrete_inputs", Table::discrete_inputs},
     {"holding_registers", Table::holding_registers},
     {"input_registers", Table::input_registers}}};

struct TypeName {
  const char* name;
  PointType type;
  int registers;  // 0: told by the point
};
constexpr std::array<TypeName, 7> types{{{"boolean", PointType::boolean, 1},
                                         {"int16", PointType::int16, 1},
                                         {"uint16", PointType::uint16, 1},
                                         {"int32", PointType::int32, 2},
                                         {"uint32", PointType::uint32, 2},
                                         {"float32", PointType::float32, 2},
                                         {"text", PointType::text, 0}}};

bool is_bit_table(Table table) { return table == Table::coils || table == Table::discrete_inputs; }

Table read_table(const YamlNode& node) {
  for (const auto& [name, table] : tables) {
    if (node.text() == name) {
      return table;
    }
  }
  node.fail("coils, discrete_inputs, holding_registers or input_registers");
}

TypeName read_type(const YamlNode& node, Table table) {
  for (const TypeName& known : types) {
    if (node.text() == known.name && is_bit_table(table) == (known.type == PointType::boolean)) {
      return known;
    }
  }
  node.fail(is_bit_table(table) ? "boolean" : "int16, uint16, int32, uint32, float32 or text");
}

bool read_word_order(const YamlNode& node) { return node.choice({"ABCD", "CDAB"}) == "CDAB"; }

std::vector<Symbol> read_symbols(const YamlNode& node, const char* key, int highest) {
  std::vector<Symbol> symbols;
  for (const YamlNode& item : node.list()) {
    symbols.push_back(item.read_map([&](YamlMap& map) {
      const YamlNode number = map.required(key);
      Symbol symbol{number.integer(0, highest), map.required("name").id(),
                    map.required("meaning").line()};
      for (const Symbol& other : symbols) {
        if (other.value == symbol.value || other.name == symbol.name) {
          number.fail(fmt::format("another {} and name than those of '{}'", key, other.name));
        }
      }
      return symbol;
    }));
  }
  return symbols;
}

/// Reads the points of a map in order, and gives them their addresses.
class Reader {
 public:
  Block read_block(YamlMap& map) {
    Block block{.id = map.required("id").id(), .title = map.required("title").line(), .points = {}};
    table_ = read_table(map.required("table"));
    next_ = map.required("address").integer(0, highest_address);
    const auto flag = [&](const char* key) {
      const auto node = map.optional(key);
      return node && node->boolean();
    };
    block.is_simulation = flag("simulation");
    block.is_monitored = flag("monitored");
    const auto order = map.optional("word_order");
    is_swapped_ = order && read_word_order(*order);
    if (const auto notes = map.optional("notes")) {
      block.notes = notes->text();
    }
    for (const YamlNode& node : map.required("points").list()) {
      node.read_map([&](YamlMap& point) {
        read_entry(point, block.points);
        return 0;
      });
    }
    return block;
  }

 private:
  void read_entry(YamlMap& map, std::vector<Point>& points) {
    if (const auto skip = map.optional("skip")) {
      next_ += skip->integer(1, highest_address);
    } else if (const auto field = map.optional("bits_of")) {
      read_bits_of(*field, points);
    } else {
      read_point(map, points);
    }
  }

  const Point& known_point(const YamlNode& node) const {
    const auto found = known_.find(node.id());
    if (found == known_.end()) {
      node.fail("the id of a point above");
    }
    return found->second;
  }

  void read_bits_of(const YamlNode& node, std::vector<Point>& points) {
    const int first = next_;
    for (const Symbol& symbol : known_point(node).symbols) {
      Point bit{
          .id = symbol.name, .value = symbol.name, .table = table_, .meaning = symbol.meaning};
      bit.type = PointType::boolean;
      next_ = first + symbol.value;
      place(bit, node, points);
    }
  }

  void read_point(YamlMap& map, std::vector<Point>& points) {
    const YamlNode id = map.required("id");
    const YamlNode type_node = map.required("type");
    const TypeName type = read_type(type_node, table_);
    Point point{.id = id.id(), .value = id.id(), .table = table_, .meaning = ""};
    point.type = type.type;
    point.registers =
        type.registers > 0 ? type.registers : map.required("registers").integer(1, longest_text);
    point.meaning = map.required("meaning").line();
    read_form(map, point);
    read_contents(map, point);
    read_symbols_of(map, point);
    const auto each = map.optional("each_channel");
    if (!each || !each->boolean()) {
      place(point, id, points);
      return;
    }
    for (int channel = 0; channel < channels; ++channel) {
      Point one = point;
      one.id = fmt::format("{}_{}", point.id, channel + 1);
      one.channel = channel;
      place(one, id, points);
    }
  }

  void read_form(YamlMap& map, Point& point) const {
    if (const auto unit = map.optional("unit")) {
      point.unit = unit->line();
    }
    if (const auto scale = map.optional("scale")) {
      if (point.type != PointType::int16) {
        scale->fail("no scale for a type other than int16");
      }
      point.scale = scale->number(Range::positive());
    }
    const auto order = map.optional("word_order");
    point.is_word_swapped = order ? read_word_order(*order) : is_swapped_;
    if (const auto writable = map.optional("writable")) {
      point.is_writable = writable->boolean();
      if (point.is_writable && table_ != Table::coils && table_ != Table::holding_registers) {
        writable->fail("nothing writable in a table that is read only");
      }
    }
  }

  static void read_contents(YamlMap& map, Point& point) {
    const auto value = map.optional("value");
    const auto constant = map.optional("constant");
    if (value) {
      point.value = value->id();
    }
    if (!constant) {
      return;
    }
    if (value || point.is_writable) {
      constant->fail("no constant beside value or writable");
    }
    point.constant = constant->text();
    point.value.clear();
    if (point.type != PointType::text && !parse_quantity(*point.constant, Dimension::number)) {
      constant->fail("a number");
    }
    if (point.type == PointType::text &&
        point.constant->size() > 2 * static_cast<std::size_t>(point.registers)) {
      constant->fail(fmt::format("up to {} characters", 2 * point.registers));
    }
  }

  void read_symbols_of(YamlMap& map, Point& point) const {
    const auto bits = map.optional("bits");
    const auto symbols = map.optional("symbols");
    const auto others = map.optional("symbols_of");
    if (bits) {
      point.is_bit_field = true;
      point.symbols = read_symbols(*bits, "bit", 16 * point.registers - 1);
    } else if (symbols) {
      point.symbols = read_symbols(*symbols, "value", highest_address);
    } else if (others) {
      point.symbols = known_point(*others).symbols;
      point.is_bit_field = known_point(*others).is_bit_field;
    }
  }

  void place(Point point, const YamlNode& node, std::vector<Point>& points) {
    if (next_ + point.registers - 1 > highest_address) {
      node.fail(fmt::format("addresses up to {}", highest_address),
                fmt::format("{}", next_ + point.registers - 1));
    }
    point.address = static_cast<std::uint16_t>(next_);
    next_ += point.registers;
    for (const auto& [id, other] : known_) {
      if (other.address <= point.last_address() && point.address <= other.last_address()) {
        node.fail(fmt::format("an address that '{}' does not use", id),
                  fmt::format("{}", point.address));
      }
    }
    if (!known_.emplace(point.id, point).second) {
      node.fail("an id that no other point has", point.id);
    }
    points.push_back(std::move(point));
  }

  std::map<std::string, Point> known_;
  Table table_ = Table::input_registers;
  bool is_swapped_ = false;
  int next_ = 0;
};

Convention read_convention(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    return Convention{map.required("topic").line(), map.required("rule").line()};
  });
}

}  // namespace

std::string name_of(PointType type) {
  return std::ranges::find(types, type, &TypeName::type)->name;
}

std::string name_of(Table table) {
  return std::ranges::find(tables, table, &std::pair<const char*, Table>::second)->first;
}

int Point::reference_number() const {
  constexpr std::array<int, 4> digits{0, 1, 4, 3};  // by Table
  const int digit = digits[static_cast<std::size_t>(table)];
  return digit * (address > last_of_five_digits ? 100'000 : 10'000) + address + 1;
}

const RegisterMap& RegisterMap::standard() {
  static const RegisterMap map =
      read_register_map(YamlNode::parse(register_map_text, "register_map.yaml"));
  return map;
}

const Point* RegisterMap::find(const std::string& id) const {
  for (const Block& block : blocks) {
    for (const Point& point : block.points) {
      if (point.id == id) {
        return &point;
      }
    }
  }
  return nullptr;
}

RegisterMap read_register_map(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    map.expect_schema("gonio/register_map/1");
    RegisterMap result;
    result.version = map.required("version").integer(1, highest_address);
    result.title = map.required("title").line();
    if (const auto notes = map.optional("notes")) {
      result.notes = notes->text();
    }
    if (const auto conventions = map.optional("conventions")) {
      for (const YamlNode& item : conventions->list()) {
        result.conventions.push_back(read_convention(item));
      }
    }
    Reader reader;
    std::map<std::string, int> block_ids;
    for (const YamlNode& item : map.required("blocks").list()) {
      result.blocks.push_back(item.read_map([&](YamlMap& block) {
        const YamlNode id = block.required("id");
        if (!block_ids.emplace(id.id(), 0).second) {
          id.fail("an id that no other block has");
        }
        return reader.read_block(block);
      }));
    }
    return result;
  });
}

}  // namespace gonio

#include "emulator/protocol/register_map_documents.hpp"

#include <fmt/format.h>

#include "emulator/core/csv_cell.hpp"

namespace gonio {

namespace {

using modbus::Table;

/// With the leading zero that the numbers of coils have.
std::string reference_number(const Point& point) {
  return fmt::format("{:05}", point.reference_number());
}

std::string address_range(int first, int last) {
  return first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last);
}

std::string how_to_read(Table table) {
  switch (table) {
    case Table::coils:
      return "Coils: read with function code 1, write with 5 and 15.";
    case Table::discrete_inputs:
      return "Discrete inputs: read with function code 2.";
    case Table::holding_registers:
      return "Holding registers: read with function code 3, write with 6, 16, 22 and 23.";
    case Table::input_registers:
      return "Input registers: read with function code 4, or 3.";
  }
  return "";
}

std::string type_of(const Point& point) {
  std::string text = name_of(point.type);
  if (point.type == PointType::text) {
    text += fmt::format(", {} characters", 2 * point.registers);
  }
  if (point.is_word_swapped) {
    text += ", CDAB";
  }
  if (point.scale != 1.0) {
    text += fmt::format(", times {}", point.scale);
  }
  return text;
}

std::string access_of(const Point& point) { return point.is_writable ? "read, write" : "read"; }

/// The first point of the map with the same symbols.
const Point& first_with_symbols_of(const RegisterMap& map, const Point& point) {
  const auto same = [](const Symbol& a, const Symbol& b) {
    return a.value == b.value && a.name == b.name && a.meaning == b.meaning;
  };
  for (const Block& block : map.blocks) {
    for (const Point& other : block.points) {
      if (other.is_bit_field == point.is_bit_field &&
          std::ranges::equal(other.symbols, point.symbols, same)) {
        return other;
      }
    }
  }
  return point;
}

std::string symbols_of(const RegisterMap& map, const Point& point) {
  const Point& first = first_with_symbols_of(map, point);
  if (first.id != point.id) {
    return point.channel.value_or(0) > 0
               ? ""
               : fmt::format("\nSymbols of `{}` are those of `{}`.\n", point.id, first.id);
  }
  std::string text =
      fmt::format("\n| `{}` | {} | meaning |\n|---|---|---|\n",
                  point.channel ? point.value : point.id, point.is_bit_field ? "bit" : "value");
  for (const Symbol& symbol : point.symbols) {
    text += fmt::format("| `{}` | {} | {} |\n", symbol.name, symbol.value, symbol.meaning);
  }
  return text;
}

std::string section(const RegisterMap& map, const Block& block) {
  std::string text = fmt::format("\n## {}\n\n{}", block.title, how_to_read(block.points[0].table));
  if (!block.notes.empty()) {
    text += " " + block.notes;
  }
  text +=
      "\n\n| address | number | id | type | unit | access | meaning |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Point& point : block.points) {
    text += fmt::format("| {} | {} | `{}` | {} | {} | {} | {} |\n",
                        address_range(point.address, point.last_address()), reference_number(point),
                        point.id, type_of(point), point.unit, access_of(point), point.meaning);
  }
  for (const Point& point : block.points) {
    if (!point.symbols.empty()) {
      text += symbols_of(map, point);
    }
  }
  return text;
}

}  // namespace

std::string symbol_list(const Point& point) {
  std::string text;
  for (const Symbol& symbol : point.symbols) {
    text += fmt::format("{}{}{} = {}", text.empty() ? "" : ", ", point.is_bit_field ? "bit " : "",
                        symbol.value, symbol.name);
  }
  return text;
}

std::string register_page(const RegisterMap& map) {
  std::string text = fmt::format("# {}\n\nVersion {}. {}\n\n| topic | rule |\n|---|---|\n",
                                 map.title, map.version, map.notes);
  for (const Convention& convention : map.conventions) {
    text += fmt::format("| {} | {} |\n", convention.topic, convention.rule);
  }
  text += "\n| addresses | table | block |\n|---|---|---|\n";
  for (const Block& block : map.blocks) {
    text +=
        fmt::format("| {} | {} | {} |\n",
                    address_range(block.points.front().address, block.points.back().last_address()),
                    name_of(block.points.front().table), block.title);
  }
  for (const Block& block : map.blocks) {
    text += section(map, block);
  }
  return text;
}

std::string register_csv(const RegisterMap& map) {
  std::string text =
      "address,number,table,id,type,registers,word_order,scale,unit,access,block,simulation,"
      "symbols,meaning\n";
  for (const Block& block : map.blocks) {
    for (const Point& point : block.points) {
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", point.address,
                      reference_number(point), name_of(point.table), point.id, name_of(point.type),
                      point.registers, point.is_word_swapped ? "CDAB" : "ABCD", point.scale,
                      csv_cell(point.unit), point.is_writable ? "read_write" : "read", block.id,
                      block.is_simulation, csv_cell(symbol_list(point)), csv_cell(point.meaning));
    }
  }
  return text;
}

}  // namespace gonio

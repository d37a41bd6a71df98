#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/protocol/modbus.hpp"

namespace gonio {

/// How a value lies in registers; high byte first, and high word first for the 32-bit types.
enum class PointType { boolean, int16, uint16, int32, uint32, float32, text };

/// As in the YAML, e.g. "float32", "input_registers".
[[nodiscard]] std::string name_of(PointType type);
[[nodiscard]] std::string name_of(modbus::Table table);

/// A word that a number stands for, or a bit of a bit field.
struct Symbol {
  int value = 0;  ///< the number, or the number of the bit
  std::string name;
  std::string meaning;
};

/// One value of the register map.
struct Point {
  std::string id;     ///< e.g. gloss_20; unique
  std::string value;  ///< what it shows: names a value of the instrument, e.g. "gloss", or "bits"
  std::optional<int> channel = {};  ///< 0, 1, 2 for values by channel
  modbus::Table table = modbus::Table::input_registers;
  std::uint16_t address = 0;  ///< of the PDU, from 0
  PointType type = PointType::uint16;
  int registers = 1;  ///< registers it takes; 1 for a bit
  std::string unit = {};
  double scale = 1.0;            ///< value = raw * scale, for integers
  bool is_word_swapped = false;  ///< low word first (CDAB)
  bool is_writable = false;
  bool is_bit_field = false;                 ///< symbols are bits
  std::optional<std::string> constant = {};  ///< what it always holds; value is empty then
  std::vector<Symbol> symbols = {};
  std::string meaning;

  [[nodiscard]] int last_address() const { return address + registers - 1; }
  /// The number of old that people know, e.g. 40001 for holding register 0.
  [[nodiscard]] int reference_number() const;
};

/// Points that belong together; a stretch of addresses.
struct Block {
  std::string id;
  std::string title;
  std::string notes = {};
  bool is_simulation = false;  ///< absent from a server that hides what a real instrument has not
  bool is_monitored = false;   ///< what a monitoring system polls
  std::vector<Point> points;
};

/// A rule that holds for all points.
struct Convention {
  std::string topic, rule;
};

/// What stands at which address, from emulator/protocol/register_map.yaml.
struct RegisterMap {
  int version = 1;
  std::string title;
  std::string notes = {};
  std::vector<Convention> conventions = {};
  std::vector<Block> blocks;

  /// The one map of gonio, which is part of the program. Read once.
  [[nodiscard]] static const RegisterMap& standard();
  /// @return  the point with that id, or null.
  [[nodiscard]] const Point* find(const std::string& id) const;
};

/// Reads a file of schema gonio/register_map/1.
///
/// A point names the value it shows by `value`, or by its id if that is missing; `value: bits` puts
/// together the values named by its symbols. No address is used twice, not even in two tables: some
/// formats of register maps have one key space for all four.
///
/// @throws InputError  for anything that is not as the schema says: points that overlap, an unknown
///                     type, an address beyond 65535, an id used twice.
[[nodiscard]] RegisterMap read_register_map(const YamlNode& node);

}  // namespace gonio

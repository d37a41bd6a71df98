#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "emulator/protocol/unit.hpp"

namespace gonio::test {

/// One table: values from an address on.
template <class Value>
struct FakeTable {
  std::uint16_t first = 0;
  std::vector<Value> values = {};
  std::set<std::uint16_t> holes = {}, read_only = {};

  [[nodiscard]] bool has(std::uint16_t address, std::size_t count) const {
    if (count == 0 || address + count > 65536) {
      throw std::logic_error("FakeTable: a unit is never asked for that");
    }
    return address >= first && address + count <= first + values.size() &&
           misses(holes, address, count);
  }
  [[nodiscard]] bool has_writable(std::uint16_t address, std::size_t count) const {
    return has(address, count) && misses(read_only, address, count);
  }
  void read(std::uint16_t address, std::span<Value> out) const {
    std::copy_n(values.begin() + (address - first), out.size(), out.begin());
  }
  void write(std::uint16_t address, std::span<const Value> in) {
    std::copy(in.begin(), in.end(), values.begin() + (address - first));
  }
  bool operator==(const FakeTable&) const = default;

 private:
  [[nodiscard]] static bool misses(const std::set<std::uint16_t>& spots, std::uint16_t address,
                                   std::size_t count) {
    const auto spot = spots.lower_bound(address);
    return spot == spots.end() || *spot >= address + count;
  }
};

/// A unit of four plain tables, with holes and read-only places, that fails when told to.
struct FakeUnit final : modbus::Unit {
  FakeTable<std::uint8_t> coils, discrete_inputs;
  FakeTable<std::uint16_t> holding_registers, input_registers;
  modbus::Identification identity = {};
  modbus::Exception failure = modbus::Exception::none;  ///< what writes are answered with

  /// All tables begin at `first` with `count` zeros.
  FakeUnit(std::uint16_t first, std::size_t count)
      : coils{.first = first, .values = std::vector<std::uint8_t>(count)},
        discrete_inputs(coils),
        holding_registers{.first = first, .values = std::vector<std::uint16_t>(count)},
        input_registers(holding_registers) {}

  [[nodiscard]] bool has_same_values(const FakeUnit& other) const {
    return coils == other.coils && discrete_inputs == other.discrete_inputs &&
           holding_registers == other.holding_registers && input_registers == other.input_registers;
  }

  [[nodiscard]] modbus::Exception check(modbus::Table table, std::uint16_t address,
                                        std::size_t count) const override {
    const bool has = table == modbus::Table::coils             ? coils.has(address, count)
                     : table == modbus::Table::discrete_inputs ? discrete_inputs.has(address, count)
                     : table == modbus::Table::holding_registers
                         ? holding_registers.has(address, count)
                         : input_registers.has(address, count);
    return has ? modbus::Exception::none : modbus::Exception::illegal_data_address;
  }
  void read_registers(modbus::Table table, std::uint16_t address,
                      std::span<std::uint16_t> out) override {
    (table == modbus::Table::holding_registers ? holding_registers : input_registers)
        .read(address, out);
  }
  void read_bits(modbus::Table table, std::uint16_t address, std::span<std::uint8_t> out) override {
    (table == modbus::Table::coils ? coils : discrete_inputs).read(address, out);
  }
  modbus::Exception write_registers(std::uint16_t address,
                                    std::span<const std::uint16_t> values) override {
    return write(holding_registers, address, values);
  }
  modbus::Exception write_coils(std::uint16_t address,
                                std::span<const std::uint8_t> bits) override {
    return write(coils, address, bits);
  }
  [[nodiscard]] const modbus::Identification& identification() const override { return identity; }

 private:
  template <class Value>
  modbus::Exception write(FakeTable<Value>& table, std::uint16_t address,
                          std::span<const Value> values) const {
    if (!table.has_writable(address, values.size())) {
      return modbus::Exception::illegal_data_address;
    }
    if (failure == modbus::Exception::none) {
      table.write(address, values);
    }
    return failure;
  }
};

}  // namespace gonio::test

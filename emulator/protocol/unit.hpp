#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "emulator/protocol/modbus.hpp"

namespace gonio::modbus {

/// What a unit says of itself to function codes 43/14 and 17.
struct Identification {
  /// Objects of function code 43/14 by number: 0 vendor, 1 product code, 2 revision, 3 URL,
  /// 4 product, 5 model, 6 application, 0x80 and up private; each up to 244 characters.
  std::map<std::uint8_t, std::string> objects;
};

/// A unit as the PDU function sees it: four tables of bits and registers. Addresses are those of
/// the PDU, from 0. Everything that one call reads is of one moment; a write is all or nothing.
class Unit {
 public:
  virtual ~Unit() = default;

  /// @return  none if all of [address, address + count) can be read in that table, else
  ///          illegal_data_address. 0 < count, address + count <= 65536.
  [[nodiscard]] virtual Exception check(Table table, std::uint16_t address,
                                        std::size_t count) const = 0;

  /// Reads out.size() registers or bits (0 or 1). Only after check() said none.
  virtual void read_registers(Table table, std::uint16_t address, std::span<std::uint16_t> out) = 0;
  virtual void read_bits(Table table, std::uint16_t address, std::span<std::uint8_t> out) = 0;

  /// Writes holding registers. @return  none; illegal_data_address for what is not there, is read
  /// only, or is part of a longer value; illegal_data_value for a value out of its range;
  /// server_device_busy or server_device_failure if the instrument says so. Nothing has changed
  /// unless it is none.
  virtual Exception write_registers(std::uint16_t address,
                                    std::span<const std::uint16_t> values) = 0;
  virtual Exception write_coils(std::uint16_t address, std::span<const std::uint8_t> bits) = 0;

  [[nodiscard]] virtual const Identification& identification() const = 0;
};

}  // namespace gonio::modbus

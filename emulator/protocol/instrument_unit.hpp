#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "emulator/protocol/counters.hpp"
#include "emulator/protocol/fault_plan.hpp"
#include "emulator/protocol/instrument_values.hpp"
#include "emulator/protocol/instrument_write.hpp"
#include "emulator/protocol/register_image.hpp"
#include "emulator/protocol/register_map.hpp"
#include "emulator/protocol/unit.hpp"

namespace gonio {

/// An instrument behind the register map: encodes what the device shows, decodes what is written.
/// A register image is made anew only when the device's revision, its clock's second, or a counter
/// that is read has changed.
class InstrumentUnit final : public modbus::Unit {
 public:
  struct Options {
    bool has_simulation_registers = true;  ///< what lies on the port, faults on demand
    std::string firmware_version;          ///< major.minor.patch
  };

  /// @param device    outlives this; a write changes all of it or nothing, by assignment.
  /// @param counters  of the server; outlives this.
  /// @param faults    what the fault registers write to; outlives this.
  InstrumentUnit(Device& device, FaultPlan& faults, const Counters& counters, Options options);

  /// Holding registers can be read where input registers are, too.
  [[nodiscard]] modbus::Exception check(modbus::Table table, std::uint16_t address,
                                        std::size_t count) const override;
  void read_registers(modbus::Table table, std::uint16_t address,
                      std::span<std::uint16_t> out) override;
  void read_bits(modbus::Table table, std::uint16_t address, std::span<std::uint8_t> out) override;
  modbus::Exception write_registers(std::uint16_t address,
                                    std::span<const std::uint16_t> values) override;
  modbus::Exception write_coils(std::uint16_t address, std::span<const std::uint8_t> bits) override;
  [[nodiscard]] const modbus::Identification& identification() const override {
    return identification_;
  }

 private:
  /// What a slot of the image shows.
  struct Binding {
    const InstrumentValue* value = nullptr;  ///< null for constants and bit fields
    const InstrumentSetter* setter = nullptr;
    std::vector<std::pair<int, const InstrumentValue*>> bits = {};
  };

  [[nodiscard]] static Binding bind(const Point& point);
  [[nodiscard]] InstrumentView view() const;
  [[nodiscard]] modbus::Table home(modbus::Table table, std::uint16_t address,
                                   std::size_t count) const;
  std::span<const std::uint16_t> read(modbus::Table table, std::uint16_t address,
                                      std::size_t count);
  void refresh();
  void encode(std::size_t slot);
  [[nodiscard]] double number(std::size_t slot) const;
  modbus::Exception write(modbus::Table table, std::uint16_t address,
                          std::span<const std::uint16_t> values);
  [[nodiscard]] modbus::Exception gather(std::size_t slot, std::span<const std::uint16_t> words,
                                         InstrumentWrite& write);

  Device& device_;
  FaultPlan& faults_;
  const Counters& counters_;
  Options options_;
  UnitState state_;
  std::array<int, 3> firmware_version_;
  modbus::Identification identification_;
  RegisterImage image_;
  std::vector<Binding> bindings_;                 ///< by slot of the image
  std::vector<std::size_t> changing_, counting_;  ///< slots
  std::uint64_t encoded_revision_ = 0;
  double encoded_second_ = -1.0;
};

}  // namespace gonio

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/protocol/instrument_unit.hpp"
#include "emulator/protocol/register_codec.hpp"

namespace gonio::test {

inline Channel channel(const std::string& id, double angle_deg) {
  return {.geometry_id = id,
          .theta_i = degrees(angle_deg),
          .tile_assigned_gu = 90.0,
          .tile_optics_gu = 90.0,
          .setup = {StatedAngle{degrees(angle_deg + 0.04), degrees(0.02)}}};
}

/// Measures at once and without noise, but wants a calibration first.
inline Behaviour quick() {
  Behaviour behaviour = Behaviour{}.ideal();
  behaviour.calibration_required = true;
  behaviour.full_scale_gu = {};
  return behaviour;
}

/// An instrument on the bench, with the registers in front of it: reads and writes by point id.
class BenchInstrument {
 public:
  explicit BenchInstrument(const Behaviour& behaviour = quick(), int channels = 3,
                           bool has_simulation = true)
      : device_({.manufacturer = "Maker",
                 .model = "Glossmeter 3",
                 .serial_number = "SN-0042",
                 .url = "https://example.org",
                 .calibration_date = "2024-05-17",
                 .calibration_text = "by hand"},
                behaviour,
                first<Channel>({channel("20", 20), channel("60", 60), channel("85", 85)}, channels),
                {{"matt", "Matt", first<double>({1.5, 10.25, 40.0}, channels)},
                 {"glossy", "Glossy", first<double>({123.456, 101.04, 95.96}, channels)}}),
        unit_(device_, faults_, counters_,
              {.has_simulation_registers = has_simulation, .firmware_version = "1.20.3"}) {}

  Device& device() { return device_; }
  FaultPlan& faults() { return faults_; }
  Counters& counters() { return counters_; }
  InstrumentUnit& unit() { return unit_; }

  static const Point& point(const std::string& id) {
    const Point* point = RegisterMap::standard().find(id);
    EXPECT_NE(point, nullptr) << id;
    return *point;
  }

  std::vector<std::uint16_t> words(modbus::Table table, int address, int count) {
    const auto from = static_cast<std::uint16_t>(address);
    std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
    EXPECT_EQ(unit_.check(table, from, words.size()), modbus::Exception::none) << address;
    if (table == modbus::Table::coils || table == modbus::Table::discrete_inputs) {
      std::vector<std::uint8_t> bits(words.size());
      unit_.read_bits(table, from, bits);
      words.assign(bits.begin(), bits.end());
    } else {
      unit_.read_registers(table, from, words);
    }
    return words;
  }
  std::vector<std::uint16_t> words(const Point& point) {
    return words(point.table, point.address, point.registers);
  }
  double number(const std::string& id) { return decode_number(point(id), words(point(id))); }
  std::string text(const std::string& id) { return decode_text(words(point(id))); }

  static std::vector<std::uint16_t> encoded(const std::string& id, double number) {
    std::vector<std::uint16_t> words(static_cast<std::size_t>(point(id).registers));
    encode_number(point(id), number, words);
    return words;
  }
  modbus::Exception write(const std::string& id, double number) {
    if (point(id).table == modbus::Table::coils) {
      const std::vector<std::uint8_t> bit{static_cast<std::uint8_t>(number)};
      return unit_.write_coils(point(id).address, bit);
    }
    return unit_.write_registers(point(id).address, encoded(id, number));
  }
  /// The same, which has to succeed.
  void set(const std::string& id, double number) {
    ASSERT_EQ(write(id, number), modbus::Exception::none) << id << " = " << number;
  }

  /// Calibrates it on its tile, and lays a sample on the port.
  void calibrate() {
    set("cover", 1);
    set("command", 2);
    device_.advance(10.0);
    ASSERT_EQ(number("command_state"), 2);
    set("sample", 1);
    set("cover", 3);
  }

  /// Everything that can be read, and what lies behind it.
  std::vector<std::uint64_t> everything() {
    std::vector<std::uint64_t> all{device_.revision(), faults_.rules().size()};
    for (const Block& block : RegisterMap::standard().blocks) {
      for (const Point& one : block.points) {
        const std::vector<std::uint16_t> values = words(one);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }

 private:
  template <class T>
  static std::vector<T> first(std::vector<T> all, int count) {
    all.resize(static_cast<std::size_t>(count));
    return all;
  }

  Device device_;
  FaultPlan faults_;
  Counters counters_;
  InstrumentUnit unit_;
};

}  // namespace gonio::test

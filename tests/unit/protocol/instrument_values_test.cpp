#include "emulator/protocol/instrument_values.hpp"

#include <gmock/gmock.h>

#include <set>
#include <string>
#include <vector>

#include "emulator/protocol/instrument_write.hpp"
#include "tests/unit/protocol/bench_instrument.hpp"

namespace gonio {
namespace {

using testing::ContainerEq;

std::set<std::string> named_by_map() {
  std::set<std::string> names;
  for (const Block& block : RegisterMap::standard().blocks) {
    for (const Point& point : block.points) {
      if (point.value == "bits") {
        for (const Symbol& symbol : point.symbols) {
          names.insert(symbol.name);
        }
      } else if (!point.constant) {
        names.insert(point.value);
      }
    }
  }
  return names;
}

TEST(InstrumentValues, AreThoseThatTheMapNames) {
  std::set<std::string> known;
  for (const auto& [name, value] : instrument_values()) {
    known.insert(name);
    EXPECT_NE(value.number == nullptr, value.text == nullptr) << name;
  }
  EXPECT_THAT(known, ContainerEq(named_by_map()));
}

TEST(InstrumentSetters, AreThoseOfTheWritablePoints) {
  std::set<std::string> known, writable;
  for (const auto& [name, setter] : instrument_setters()) {
    known.insert(name);
  }
  for (const Block& block : RegisterMap::standard().blocks) {
    for (const Point& point : block.points) {
      if (point.is_writable) {
        writable.insert(point.value);
      }
    }
  }
  EXPECT_THAT(known, ContainerEq(writable));
}

/// The names that the map gives to 0, 1, 2, ...
std::vector<std::string> names(const std::string& id) {
  std::vector<std::string> result;
  for (const Symbol& symbol : test::BenchInstrument::point(id).symbols) {
    EXPECT_EQ(symbol.value, static_cast<int>(result.size())) << id;
    result.push_back(symbol.name);
  }
  return result;
}

template <class Enum>
std::string name(const std::string& id, Enum value) {
  return names(id).at(static_cast<std::size_t>(value));
}

TEST(RegisterMapSymbols, NameTheNumbersOfTheDevice) {
  EXPECT_EQ(name("state", DeviceState::fault), "fault");
  EXPECT_EQ(name("state", DeviceState::measuring), "measuring");
  EXPECT_EQ(name("active_mode", MeasuringMode::statistics), "statistics");
  EXPECT_EQ(name("active_mode", MeasuringMode::pass_fail), "pass_fail");
  EXPECT_EQ(name("last_command", DeviceCommand::measure), "measure");
  EXPECT_EQ(name("last_command", DeviceCommand::store_reference), "store_reference");
  EXPECT_EQ(name("last_command", DeviceCommand::save_settings), "save_settings");
  EXPECT_EQ(name("last_command", DeviceCommand::restart), "restart");
  EXPECT_EQ(name("command_state", CommandState::failed), "failed");
  EXPECT_EQ(name("command_error", DeviceError::not_on_tile), "not_on_tile");
  EXPECT_EQ(name("command_error", DeviceError::storage_failed), "storage_failed");
  EXPECT_EQ(name("command_error", DeviceError::unknown_command), "unknown_command");
  EXPECT_EQ(name("alarms", Alarm::over_range), "alarm_over_range");
  EXPECT_EQ(name("alarms", Alarm::storage_failed), "alarm_storage_failed");
  EXPECT_EQ(name("reading_state_1", ReadingStatus::over_range), "over_range");
  EXPECT_EQ(name("verdict_1", Verdict::above), "above");
  EXPECT_EQ(name("cover", PortCover::sample), "sample");
  EXPECT_EQ(name("faults", InstrumentFault::tile_dirty), "tile_dirty");
  EXPECT_EQ(name("wire_fault", WireFault::close), "close");
  EXPECT_EQ(name("wire_fault", WireFault::exception), "exception");
}

TEST(RegisterMapSymbols, AreAsManyAsTheDeviceHas) {
  EXPECT_EQ(names("last_command").size(), static_cast<std::size_t>(DeviceCommand::restart) + 1);
  EXPECT_EQ(names("command_error").size(),
            static_cast<std::size_t>(DeviceError::unknown_command) + 1);
  EXPECT_EQ(names("alarms").size(), static_cast<std::size_t>(Alarm::storage_failed) + 1);
  EXPECT_EQ(names("faults").size(), instrument_fault_count);
}

}  // namespace
}  // namespace gonio

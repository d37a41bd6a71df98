#include "emulator/protocol/instrument_write.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/unit/protocol/bench_instrument.hpp"

namespace gonio {
namespace {

using modbus::Exception;
using modbus::Table;
using test::BenchInstrument;
using test::quick;
using Words = std::vector<std::uint16_t>;

Behaviour slow() {
  Behaviour behaviour = quick();
  behaviour.reading_s = 0.5;
  behaviour.calibration_s = 3.0;
  return behaviour;
}

TEST(InstrumentWrite, RunsACommandAndTellsWhatBecameOfIt) {
  BenchInstrument bench(slow());
  bench.set("cover", 1);
  const double before = bench.number("command_sequence");
  bench.set("command", 2);
  EXPECT_EQ(bench.number("command"), 2);
  EXPECT_EQ(bench.number("command_state"), 1);
  EXPECT_EQ(bench.number("command_sequence"), before + 1);
  EXPECT_EQ(bench.number("run_calibrate"), 1);
  EXPECT_EQ(bench.number("busy"), 1);
  bench.device().advance(3.1);
  EXPECT_EQ(bench.number("command"), 0);
  EXPECT_EQ(bench.number("command_state"), 2);
  EXPECT_EQ(bench.number("last_command"), 2);
  EXPECT_EQ(bench.number("run_calibrate"), 0);
  EXPECT_EQ(bench.number("is_calibrated_1"), 1);
  EXPECT_EQ(bench.number("ready"), 1);
}

TEST(InstrumentWrite, IsRefusedWhileTheInstrumentIsBusy) {
  BenchInstrument bench(slow());
  bench.calibrate();
  bench.set("command", 1);
  const auto before = bench.everything();
  EXPECT_EQ(bench.write("command", 1), Exception::server_device_busy);
  EXPECT_EQ(bench.write("run_calibrate", 1), Exception::server_device_busy);
  EXPECT_EQ(bench.everything(), before);
  EXPECT_EQ(bench.write("run_stop", 1), Exception::none);
  EXPECT_EQ(bench.number("busy"), 0);
}

TEST(InstrumentWrite, LetsTheInstrumentSayNoInItsOwnWords) {
  BenchInstrument bench;
  EXPECT_EQ(bench.number("ready"), 0);
  bench.set("run_measure", 1);
  EXPECT_EQ(bench.number("command_state"), 3);
  EXPECT_EQ(bench.number("command_error"), 3);
  EXPECT_EQ(bench.number("command_failed"), 1);
}

TEST(InstrumentWrite, StartsCommandsByCoils) {
  BenchInstrument bench;
  EXPECT_EQ(bench.number("alarm_restarted"), 1);
  bench.set("run_acknowledge_alarms", 0);
  EXPECT_EQ(bench.number("alarm_restarted"), 1);
  bench.set("run_acknowledge_alarms", 1);
  EXPECT_EQ(bench.number("alarm_restarted"), 0);
  EXPECT_EQ(bench.number("alarms"), 0);
}

TEST(InstrumentWrite, RefusesCommandsThatThereAreNot) {
  BenchInstrument bench;
  EXPECT_EQ(bench.write("command", 12), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("command", 0), Exception::none);
  EXPECT_EQ(bench.number("command_sequence"), 0);
}

TEST(InstrumentWrite, SetsAndStartsInOneRequest) {
  BenchInstrument bench;
  bench.calibrate();
  // Registers 1000 to 1003: command, lock, mode, readings.
  EXPECT_EQ(bench.unit().write_registers(1000, Words{1, 0, 1, 7}), Exception::none);
  bench.device().advance(10.0);
  EXPECT_EQ(bench.number("statistics_n_1"), 7);
  EXPECT_EQ(bench.number("mean_2"), static_cast<float>(101.04));
  EXPECT_EQ(bench.number("standard_deviation_2"), 0);
}

TEST(InstrumentWrite, ChangesNothingIfOneValueIsWrong) {
  BenchInstrument bench;
  const auto before = bench.everything();
  EXPECT_EQ(bench.unit().write_registers(1000, Words{4, 0, 1, 0}), Exception::illegal_data_value);
  EXPECT_EQ(bench.unit().write_registers(1000, Words{4, 0, 9, 5}), Exception::illegal_data_value);
  EXPECT_EQ(bench.unit().write_registers(1000, Words{4, 2, 1, 5}), Exception::illegal_data_value);
  EXPECT_EQ(bench.everything(), before);
}

TEST(InstrumentWrite, ChecksSettingsByTheirRanges) {
  BenchInstrument bench;
  EXPECT_EQ(bench.write("statistics_readings", 999), Exception::none);
  EXPECT_EQ(bench.write("statistics_readings", 1000), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("interval", 0.1), Exception::none);
  EXPECT_EQ(bench.write("interval", 3601), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("interval", -1), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("measured_channels", 0), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("measured_channels", 5), Exception::none);
  EXPECT_FALSE(bench.device().settings().channels[1].is_measured);
  const Words infinite{0x7F80, 0x0000};
  EXPECT_EQ(bench.unit().write_registers(BenchInstrument::point("reference_1").address, infinite),
            Exception::illegal_data_value);
}

TEST(InstrumentWrite, NeverWritesHalfAFloat) {
  BenchInstrument bench;
  const std::uint16_t reference = BenchInstrument::point("reference_1").address;
  const auto next = static_cast<std::uint16_t>(reference + 1);
  const auto before = bench.everything();
  EXPECT_EQ(bench.unit().write_registers(reference, Words{0x42C8}),
            Exception::illegal_data_address);
  EXPECT_EQ(bench.unit().write_registers(next, Words{0x0000}), Exception::illegal_data_address);
  EXPECT_EQ(bench.unit().write_registers(next, Words{0, 0x42C8, 0}),
            Exception::illegal_data_address);
  EXPECT_EQ(bench.everything(), before);
  EXPECT_EQ(bench.unit().write_registers(reference, Words{0x42C8, 0x0000}), Exception::none);
  EXPECT_EQ(bench.number("reference_1"), 100);
}

TEST(InstrumentWrite, TakesNanAsNoChange) {
  BenchInstrument bench;
  bench.set("tile_1", 88.0);
  bench.set("tile_1", std::nan(""));
  EXPECT_EQ(bench.number("tile_1"), 88);
}

TEST(InstrumentWrite, ChangesNothingByWritingBackWhatWasRead) {
  BenchInstrument bench;
  DeviceSettings settings = bench.device().settings();
  settings.interval_s = 0.7;  // no float32
  settings.channels[2].tile_gu = 92.3;
  ASSERT_FALSE(bench.device().set(settings));
  EXPECT_EQ(bench.unit().write_registers(1002, bench.words(Table::holding_registers, 1002, 30)),
            Exception::none);
  EXPECT_EQ(bench.device().settings(), settings);
}

TEST(InstrumentWrite, LeavesSettingsAloneWhileTheyAreLocked) {
  BenchInstrument bench;
  bench.set("settings_lock", 1);
  EXPECT_EQ(bench.number("settings_locked"), 1);
  EXPECT_EQ(bench.write("mode", 1), Exception::server_device_failure);
  EXPECT_EQ(bench.write("command", 4), Exception::none);
  // Unlocking takes a request of its own.
  EXPECT_EQ(bench.unit().write_registers(1001, Words{0, 1}), Exception::server_device_failure);
  bench.set("settings_lock", 0);
  EXPECT_EQ(bench.write("mode", 1), Exception::none);
}

TEST(InstrumentWrite, SavesSettingsOrSaysThatItCannot) {
  BenchInstrument bench;
  EXPECT_EQ(bench.write("command", 8), Exception::none);
  EXPECT_EQ(bench.number("command_state"), double(CommandState::failed));
  EXPECT_EQ(bench.number("command_error"), double(DeviceError::storage_failed));
  EXPECT_EQ(bench.number("alarm_storage_failed"), 1);
  DeviceSettings saved;
  bench.device().keep_settings([&](const DeviceSettings& settings) { saved = settings; }, {});
  bench.set("tile_2", 77.0);
  bench.set("command", 8);
  EXPECT_EQ(saved.channels.at(1).tile_gu, 77.0);
  bench.set("tile_2", 78.0);
  bench.set("command", 11);
  EXPECT_EQ(bench.number("tile_2"), 77);
}

TEST(InstrumentWrite, LaysSamplesOnThePort) {
  BenchInstrument bench;
  bench.calibrate();
  EXPECT_EQ(bench.text("sample_id"), "glossy");
  EXPECT_EQ(bench.number("sample_count"), 2);
  bench.set("sample", 0);
  EXPECT_EQ(bench.device().status().sample, 0);
  EXPECT_EQ(bench.text("sample_id"), "matt");
  EXPECT_EQ(bench.write("sample", 2), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("cover", 4), Exception::illegal_data_value);
  bench.set("command", 1);
  bench.device().advance(1.0);
  EXPECT_EQ(bench.number("gloss_3"), 40.0);
}

TEST(InstrumentWrite, BreaksAndMendsTheInstrument) {
  BenchInstrument bench;
  bench.set("faults", 1);
  EXPECT_EQ(bench.number("state"), 4);
  EXPECT_EQ(bench.number("lamp_failed"), 1);
  bench.set("faults", 0);
  EXPECT_EQ(bench.number("lamp_failed"), 0);
  EXPECT_EQ(bench.write("faults", 32), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("tile_dirty", 1.5), Exception::illegal_data_value);
  bench.calibrate();
  bench.set("drift_step", -0.5);
  bench.set("faults", 8);
  bench.set("command", 1);
  bench.device().advance(1.0);
  EXPECT_NEAR(bench.number("gloss_2"), 0.5 * 101.04, 1e-4);
}

TEST(InstrumentWrite, AddsAndDropsFaultsOnTheWire) {
  BenchInstrument bench;
  // Exception 06 to function 3 at 10 to 20, twice, one request in two.
  const Words rule{2, 65535, 3, 10, 20, 2, 0x0007, 0xA120, 30, 6, 1};
  EXPECT_EQ(bench.unit().write_registers(1200, rule), Exception::none);
  ASSERT_EQ(bench.faults().rules().size(), 1U);
  const FaultRule& added = bench.faults().rules().front();
  EXPECT_EQ(added.fault, WireFault::exception);
  EXPECT_EQ(added.code, Exception::server_device_busy);
  EXPECT_FALSE(added.unit);
  EXPECT_EQ(added.function, 3);
  EXPECT_EQ(added.addresses, std::pair(std::uint16_t{10}, std::uint16_t{20}));
  EXPECT_EQ(added.count, 2U);
  EXPECT_DOUBLE_EQ(added.probability, 0.5);
  EXPECT_EQ(added.time.count(), 30);
  EXPECT_EQ(bench.number("wire_fault_rules"), 1);
  EXPECT_EQ(bench.number("wire_fault_apply"), 0);
  bench.set("wire_fault_apply", 2);
  EXPECT_EQ(bench.number("wire_fault_rules"), 0);
}

TEST(InstrumentWrite, RefusesFaultsOnTheWireThatMeanNothing) {
  BenchInstrument bench;
  EXPECT_EQ(bench.write("wire_fault", 9), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("wire_fault_unit", 248), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("wire_fault_function", 0), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("wire_fault_function", 65535), Exception::none);
  EXPECT_EQ(bench.write("wire_fault_probability", 1'000'001), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("wire_fault_code", 2), Exception::illegal_data_value);
  bench.set("wire_fault_last", 5);
  bench.set("wire_fault_first", 6);
  EXPECT_EQ(bench.write("wire_fault_apply", 1), Exception::illegal_data_value);
}

TEST(InstrumentWrite, IsAllOrNothing) {
  constexpr unsigned seed = 20'240'517;
  constexpr int writes = 20'000;
  BenchInstrument bench(slow());
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return static_cast<std::uint16_t>(random() % n); };
  int accepted = 0, refused = 0;
  for (int i = 0; i < writes; ++i) {
    constexpr std::uint16_t bases[] = {1000, 1002, 1008, 1100, 1119, 1200, 2000};
    const std::uint16_t base = bases[below(std::size(bases))];
    const auto address = static_cast<std::uint16_t>(base + below(4));
    Words words;
    for (int n = 1 + below(6); n > 0; --n) {
      words.push_back(below(8) == 0 ? below(65536) : below(3));
    }
    const auto before = bench.everything();
    Exception exception;
    if (base == 2000) {
      std::vector<std::uint8_t> bits(words.size());
      std::ranges::transform(words, bits.begin(),
                             [](auto word) { return std::uint8_t(word & 1U); });
      exception = bench.unit().write_coils(address, bits);
    } else {
      exception = bench.unit().write_registers(address, words);
    }
    ++(exception == Exception::none ? accepted : refused);
    if (exception != Exception::none) {
      ASSERT_EQ(bench.everything(), before) << "write " << i << " at " << address;
    }
    bench.device().advance(0.2);
  }
  EXPECT_GT(accepted, writes / 20);
  EXPECT_GT(refused, writes / 20);
}

}  // namespace
}  // namespace gonio

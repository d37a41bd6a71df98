#include "emulator/protocol/instrument_unit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/unit/protocol/bench_instrument.hpp"

namespace gonio {
namespace {

using modbus::Exception;
using modbus::Table;
using test::BenchInstrument;
using test::quick;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(InstrumentUnit, HasTheRegistersOfTheCommunicationTest) {
  BenchInstrument bench;
  EXPECT_THAT(bench.words(Table::input_registers, 300, 14),
              ElementsAre(0xC2F6, 0xE666, 0xE666, 0xC2F6, 0xCFC7, 0xD431, 0xF8A4, 0x32EB, 0x1234,
                          0x5678, 0x2D31, 0x3233, 0x2E34, 0x3500));
}

TEST(InstrumentUnit, TellsWhoItIs) {
  BenchInstrument bench;
  EXPECT_EQ(bench.text("serial_number"), "SN-0042");
  EXPECT_EQ(bench.words(Table::input_registers, 400, 1).front(), 0x534E);
  EXPECT_EQ(bench.text("model"), "Glossmeter 3");
  EXPECT_EQ(bench.number("firmware_minor"), 20);
  EXPECT_EQ(bench.text("sunspec_marker"), "SunS");
  EXPECT_EQ(bench.text("sunspec_version"), "1.20.3");
  EXPECT_EQ(bench.text("sunspec_options"), "20/60/85 deg");
  const auto& objects = bench.unit().identification().objects;
  EXPECT_EQ(objects.at(0x00), "Maker");
  EXPECT_EQ(objects.at(0x02), "1.20.3");
  EXPECT_EQ(objects.at(0x80), "SN-0042");
  EXPECT_EQ(objects.at(0x81), "2024-05-17");
  EXPECT_EQ(objects.at(0x82), "by hand");
  EXPECT_THAT(objects.at(0x83), HasSubstr("ABCD"));
}

TEST(InstrumentUnit, TellsTheSetUpAsItIsStated) {
  BenchInstrument bench(quick(), 2);
  EXPECT_EQ(bench.number("theta_i_2"), 60.04F);
  EXPECT_EQ(bench.number("theta_i_uncertainty_2"), 0.02F);
  for (const char* id : {"theta_r_1", "theta_r_uncertainty_1", "source_diameter_2", "theta_i_3"}) {
    EXPECT_TRUE(std::isnan(bench.number(id))) << id;  // not stated, or no such channel
  }
}

TEST(InstrumentUnit, CutsTextsOfTheIdentificationToWhatAFrameCarries) {
  Device device({.manufacturer = std::string(300, 'm')}, quick(), {test::channel("60", 60)}, {});
  FaultPlan faults;
  const Counters counters;
  const InstrumentUnit unit(device, faults, counters, {.firmware_version = "1"});
  EXPECT_EQ(unit.identification().objects.at(0).size(), 244U);
}

TEST(InstrumentUnit, ShowsOneReadingAsFloatAndAsTenths) {
  BenchInstrument bench;
  bench.calibrate();
  bench.set("command", 1);
  bench.device().advance(1.0);
  for (const char* channel : {"1", "2", "3"}) {
    const double gloss = bench.number(std::string("gloss_") + channel);
    EXPECT_NEAR(bench.number(std::string("gloss_tenths_") + channel), gloss, 0.05);
    EXPECT_EQ(bench.number(std::string("gloss_cdab_") + channel), gloss);
    EXPECT_EQ(bench.number(std::string("reading_state_") + channel), 1);
  }
  EXPECT_EQ(bench.number("gloss_1"), static_cast<float>(123.456));
  EXPECT_EQ(bench.number("sequence"), 1);
  EXPECT_EQ(bench.number("sequence_cdab"), 1);
  EXPECT_EQ(bench.number("result_valid"), 1);
}

TEST(InstrumentUnit, ReadsOneMomentInOneRequest) {
  BenchInstrument bench;
  bench.calibrate();
  bench.set("mode", 2);
  bench.set("command", 1);
  for (int i = 0; i < 50; ++i) {
    bench.device().advance(0.7);
    const auto words = bench.words(Table::input_registers, 0, 114);
    const auto number = [&](const char* id) {
      const Point& point = BenchInstrument::point(id);
      return decode_number(point, std::span(words).subspan(
                                      point.address, static_cast<std::size_t>(point.registers)));
    };
    EXPECT_EQ(number("sequence"), bench.device().status().sequence);
    EXPECT_EQ(number("sequence"), number("sequence_cdab"));
    EXPECT_EQ(number("sequence"), number("sequence_low"));
    EXPECT_EQ(number("heartbeat"), number("uptime"));
    EXPECT_EQ(number("gloss_2"), number("gloss_cdab_2"));
  }
  EXPECT_GT(bench.number("sequence"), 20);
}

TEST(InstrumentUnit, MarksWhatItHasNotMeasured) {
  BenchInstrument bench;
  EXPECT_THAT(bench.words(BenchInstrument::point("gloss_1")), ElementsAre(0x7FC0, 0));
  EXPECT_THAT(bench.words(BenchInstrument::point("gloss_tenths_1")), ElementsAre(0x8000));
  EXPECT_EQ(bench.number("reading_state_1"), 0);
  EXPECT_TRUE(std::isnan(bench.number("mean_1")));
  EXPECT_EQ(bench.number("calibration_age"), 0xFFFF'FFFF);
  EXPECT_EQ(bench.number("result_valid"), 0);
}

TEST(InstrumentUnit, MarksWhatIsOverRange) {
  Behaviour behaviour = quick();
  behaviour.full_scale_gu = {110.0, 110.0, 110.0};
  BenchInstrument bench(behaviour);
  bench.calibrate();
  bench.set("command", 1);
  bench.device().advance(1.0);
  EXPECT_THAT(bench.words(BenchInstrument::point("gloss_1")), ElementsAre(0x7FC0, 0));
  EXPECT_THAT(bench.words(BenchInstrument::point("gloss_tenths_1")), ElementsAre(0x7FFF));
  EXPECT_EQ(bench.number("reading_state_1"), 2);
  EXPECT_EQ(bench.number("over_range"), 1);
  EXPECT_EQ(bench.number("alarm_over_range"), 1);
  EXPECT_EQ(bench.number("result_valid"), 0);
  EXPECT_EQ(bench.number("reading_state_2"), 1);
}

TEST(InstrumentUnit, MarksTheChannelsItHasNot) {
  BenchInstrument bench(quick(), 1);
  EXPECT_EQ(bench.number("channel_count"), 1);
  EXPECT_EQ(bench.number("angle_1"), 20);
  EXPECT_TRUE(std::isnan(bench.number("angle_2")));
  EXPECT_THAT(bench.words(BenchInstrument::point("reading_state_3")), ElementsAre(0xFFFF));
  EXPECT_EQ(bench.write("tile_1", 95.0), Exception::none);
  EXPECT_EQ(bench.write("tile_2", 95.0), Exception::illegal_data_value);
  EXPECT_EQ(bench.write("tile_2", std::nan("")), Exception::none);
  EXPECT_EQ(bench.write("measured_channels", 3), Exception::illegal_data_value);
}

TEST(InstrumentUnit, CountsSeconds) {
  BenchInstrument bench;
  bench.device().advance(65537.5);
  EXPECT_EQ(bench.number("heartbeat"), 1);
  EXPECT_EQ(bench.number("uptime"), 65537);
  bench.device().advance(0.5);
  EXPECT_EQ(bench.number("heartbeat"), 2);
}

TEST(InstrumentUnit, ShowsCountersAsTheyStandNow) {
  BenchInstrument bench;
  EXPECT_EQ(bench.number("requests"), 0);
  bench.counters().requests = 70'000;
  bench.counters().by_function[43] = 5;
  bench.counters().exceptions = 0x1'0000'0002;
  EXPECT_EQ(bench.number("requests"), 70'000);
  EXPECT_EQ(bench.number("requests_function_43"), 5);
  EXPECT_EQ(bench.number("exceptions"), 2);
}

TEST(InstrumentUnit, ComposesTheStatusOfItsBits) {
  BenchInstrument bench;
  bench.set("cover", 1);
  const auto status = static_cast<unsigned>(bench.number("status"));
  for (const Symbol& symbol : BenchInstrument::point("status").symbols) {
    EXPECT_EQ(status >> static_cast<unsigned>(symbol.value) & 1U, bench.number(symbol.name))
        << symbol.name;
  }
  EXPECT_EQ(bench.number("on_standard"), 1);
  EXPECT_EQ(bench.number("simulated"), 1);
  EXPECT_EQ(bench.number("calibration_due"), 1);
}

TEST(InstrumentUnit, HasNothingInHoles) {
  BenchInstrument bench;
  const InstrumentUnit& unit = bench.unit();
  EXPECT_EQ(unit.check(Table::input_registers, 0, 114), Exception::none);
  EXPECT_EQ(unit.check(Table::input_registers, 0, 115), Exception::illegal_data_address);
  EXPECT_EQ(unit.check(Table::input_registers, 114, 1), Exception::illegal_data_address);
  EXPECT_EQ(unit.check(Table::input_registers, 1000, 1), Exception::illegal_data_address);
  EXPECT_EQ(unit.check(Table::coils, 1999, 2), Exception::illegal_data_address);
  EXPECT_EQ(unit.check(Table::discrete_inputs, 3000, 15), Exception::none);
  EXPECT_EQ(unit.check(Table::holding_registers, 65535, 1), Exception::illegal_data_address);
}

TEST(InstrumentUnit, ReadsInputRegistersAsHoldingRegistersToo) {
  BenchInstrument bench;
  EXPECT_EQ(bench.words(Table::holding_registers, 300, 14),
            bench.words(Table::input_registers, 300, 14));
  const std::vector<std::uint16_t> zero{0};
  EXPECT_EQ(bench.unit().write_registers(304, zero), Exception::illegal_data_address);
}

TEST(InstrumentUnit, HidesTheSimulationWhenToldTo) {
  BenchInstrument shown;
  BenchInstrument hidden(quick(), 3, false);
  for (const Block& block : RegisterMap::standard().blocks) {
    for (const Point& point : block.points) {
      const auto exists = [&](BenchInstrument& bench) {
        return bench.unit().check(point.table, point.address, 1) == Exception::none;
      };
      EXPECT_TRUE(exists(shown)) << point.id;
      EXPECT_EQ(exists(hidden), !block.is_simulation) << point.id;
    }
  }
  EXPECT_EQ(hidden.write("cover", 1), Exception::illegal_data_address);
  EXPECT_EQ(hidden.write("wire_fault_apply", 1), Exception::illegal_data_address);
  EXPECT_EQ(hidden.number("simulated"), 0);
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/serve_process.hpp"

// What `gonio serve --ideal` reads against what `gonio measure` computes.

namespace gonio {
namespace {

using modbus::Table;
using nlohmann::json;
using test::Outcome;
using test::Program;
using test::quietly;
using test::ServeProcess;

constexpr std::size_t channel_count = 3;
constexpr std::uint16_t gloss = 18, gloss_cdab = 92;  // three float32 each
constexpr std::uint16_t reading_state = 27, is_valid = 1;
constexpr std::uint16_t command = 1000, calibrate = 2, run_measure = 2000;
constexpr std::uint16_t command_state = 9, done = 2;
constexpr std::uint16_t cover = 1100, tile = 1, sample_on_port = 3;

/// By sample, what `gonio measure` computes for an instrument, by angle, as float32.
std::map<std::string, std::vector<float>> computed(const std::string& instrument,
                                                   const std::vector<std::string>& samples) {
  std::vector<std::string> arguments{"measure", "--instrument", instrument, "--format", "json"};
  for (const std::string& sample : samples) {
    arguments.insert(arguments.end(), {"--sample", sample});
  }
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, std::vector<float>> by_sample;
  const json report = json::parse(outcome.out);
  for (const json& measurement : report.at("measurements")) {
    std::vector<float>& values = by_sample[measurement.at("sample")];
    for (const json& geometry : measurement.at("geometries")) {
      values.push_back(static_cast<float>(geometry.at("gloss_gu").get<double>()));
    }
  }
  return by_sample;
}

/// The ids of all samples that ship.
std::vector<std::string> shipped_samples() {
  const Outcome outcome = Program().run({"list", "samples", "--format", "json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<std::string> ids;
  const json list = json::parse(outcome.out);
  for (const json& entry : list.at("samples")) {
    ids.push_back(entry.at("id"));
  }
  return ids;
}

void carry_out(ModbusClient& client, const std::function<void()>& start) {
  start();
  // An ideal instrument takes no time.
  ASSERT_EQ(client.read_registers(Table::input_registers, command_state, 1).at(0), done);
}

/// Bits of the float32 in two registers, the high word in the first.
std::uint32_t bits_of(std::uint16_t high, std::uint16_t low) {
  return std::uint32_t{high} << 16U | low;
}

/// Compares a snapshot of registers 0 to 113 with values bit for bit; channels beyond have none.
void expect_readings(const std::vector<std::uint16_t>& registers,
                     const std::vector<float>& values) {
  for (std::size_t i = 0; i < channel_count; ++i) {
    const std::size_t at = gloss + 2 * i, swapped_at = gloss_cdab + 2 * i;
    const std::uint32_t found = bits_of(registers[at], registers[at + 1]);
    EXPECT_EQ(bits_of(registers[swapped_at + 1], registers[swapped_at]), found);
    if (i >= values.size()) {
      EXPECT_TRUE(std::isnan(std::bit_cast<float>(found)));
      continue;
    }
    EXPECT_EQ(registers[reading_state + i], is_valid);
    EXPECT_EQ(found, std::bit_cast<std::uint32_t>(values[i]))
        << "channel " << i + 1 << ": read " << std::bit_cast<float>(found) << ", computed "
        << values[i];
  }
}

/// Lays samples on the port, one after the other, and compares what is read with what is computed.
void expect_equal_to_computation(const std::string& instrument,
                                 const std::vector<std::string>& samples, std::size_t angles,
                                 bool is_calibrated) {
  std::vector<std::string> arguments{instrument, "--ideal", "--tcp", "127.0.0.1:0"};
  for (const std::string& sample : samples) {
    arguments.insert(arguments.end(), {"--sample", sample});
  }
  const ServeProcess server(Program(), quietly(arguments));
  ModbusClient client = server.connect();
  if (is_calibrated) {
    client.write_registers(cover, {tile});
    carry_out(client, [&] { client.write_registers(command, {calibrate}); });
  }
  const auto expected = computed(instrument, samples);
  ASSERT_EQ(expected.size(), samples.size());
  for (std::size_t j = 0; j < samples.size(); ++j) {
    SCOPED_TRACE(samples[j]);
    client.write_registers(cover, {sample_on_port, static_cast<std::uint16_t>(j)});
    carry_out(client, [&] { client.write_coil(run_measure, true); });
    ASSERT_EQ(expected.at(samples[j]).size(), angles);
    expect_readings(client.read_registers(Table::input_registers, 0, 114), expected.at(samples[j]));
  }
}

TEST(ServedReadings, OfAnIdealInstrumentAreThoseOfMeasureBitForBit) {
  expect_equal_to_computation("triangle_gloss", shipped_samples(), 3, false);
}

TEST(ServedReadings, OfAnIdealInstrumentStayTheSameWhenItIsCalibrated) {
  expect_equal_to_computation("triangle_gloss", shipped_samples(), 3, true);
}

TEST(ServedReadings, OfAnInstrumentWithOneAngleLeaveTheOtherChannelsWithoutValue) {
  expect_equal_to_computation("pocket_gloss_60", {"black_matt", "steel_brushed"}, 1, true);
}

}  // namespace
}  // namespace gonio

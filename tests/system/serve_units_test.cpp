#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/system/serve_process.hpp"

// Instruments behind a server, what it hides of them, and what it counts.

namespace gonio {
namespace {

using modbus::Exception;
using modbus::Table;
using test::Program;
using test::quietly;
using test::ServeProcess;
using test::triangle;

constexpr Table inputs = Table::input_registers, holding = Table::holding_registers;
constexpr std::uint16_t test_text = 310, model = 424, channel_count = 17,
                        statistics_readings = 1003;
constexpr std::uint16_t cover = 1100, cover_words = 24, wire_fault = 1200, status_bits = 3000;
constexpr std::uint16_t hole = 900, requests = 500;

/// The exception with which something is refused; none if it is not.
Exception exception_of(const std::function<void()>& request) {
  try {
    request();
  } catch (const ModbusExceptionError& error) {
    return error.code();
  }
  return Exception::none;
}

std::string text_at(ModbusClient& client, std::uint16_t address, int registers) {
  std::string text;
  for (const std::uint16_t word : client.read_registers(inputs, address, registers)) {
    text += static_cast<char>(word >> 8U);
    text += static_cast<char>(word & 0xFFU);
  }
  return text.substr(0, text.find('\0'));
}

// Units.

TEST(ServedUnits, AreSeparateInstruments) {
  const ServeProcess server(Program(), quietly({triangle, "pocket_gloss_60", "--unit", "7",
                                                "--unit", "247", "--tcp", "127.0.0.1:0"}));
  ModbusClient first = server.connect(7), second = server.connect(247);
  EXPECT_EQ(text_at(first, model, 16), "Triangle Gloss");
  EXPECT_EQ(first.read_registers(inputs, channel_count, 1).at(0), 3);
  EXPECT_EQ(second.read_registers(inputs, channel_count, 1).at(0), 1);
  const auto before = second.read_registers(holding, statistics_readings, 1);
  first.write_registers(statistics_readings, {77});
  EXPECT_EQ(first.read_registers(holding, statistics_readings, 1).at(0), 77);
  EXPECT_EQ(second.read_registers(holding, statistics_readings, 1), before);
}

TEST(ServedUnits, ThatDoNotExistAreNotReachedByTheGateway) {
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  ModbusClient client = server.connect(9);
  EXPECT_EQ(exception_of([&] { (void)client.read_registers(inputs, 0, 1); }),
            Exception::gateway_target_failed);
}

TEST(ServedUnits, AreTheFirstOneForThoseWhoKnowNone) {
  const ServeProcess server(Program(), quietly({triangle, "--unit", "12", "--tcp", "127.0.0.1:0"}));
  for (const int unit : {0, 255}) {
    ModbusClient client = server.connect(unit);
    EXPECT_EQ(text_at(client, test_text, 4), "-123.45") << "unit " << unit;
  }
}

// What a real instrument has not.

TEST(SimulationRegisters, AreThereUnlessHidden) {
  const ServeProcess open(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  const ServeProcess hidden(Program(),
                            quietly({triangle, "--no-simulation", "--tcp", "127.0.0.1:0"}));
  ModbusClient client = open.connect(), outsider = hidden.connect();
  EXPECT_EQ(client.read_registers(holding, cover, cover_words).size(), cover_words);
  client.write_registers(cover, {1});
  for (const std::uint16_t address : {cover, wire_fault}) {
    EXPECT_EQ(exception_of([&] { (void)outsider.read_registers(holding, address, 1); }),
              Exception::illegal_data_address);
    EXPECT_EQ(exception_of([&] { outsider.write_registers(address, {0}); }),
              Exception::illegal_data_address);
  }
  constexpr int simulated = 14;
  EXPECT_TRUE(client.read_bits(Table::discrete_inputs, status_bits + simulated, 1).at(0));
  EXPECT_FALSE(outsider.read_bits(Table::discrete_inputs, status_bits + simulated, 1).at(0));
}

// Counters.

TEST(ServeCounters, EqualWhatWasSent) {
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  ModbusClient client = server.connect();
  const ModbusClient other = server.connect();
  for (int i = 0; i < 5; ++i) {
    (void)client.read_registers(holding, statistics_readings, 1);
    (void)exception_of([&] { (void)client.read_registers(holding, hole, 1); });
  }
  for (int i = 0; i < 3; ++i) {
    (void)client.read_bits(Table::coils, 2000, 5);
    (void)client.read_bits(Table::discrete_inputs, status_bits, 5);
    client.write_registers(statistics_readings, {12});
  }
  client.write_coil(2003, true);
  const auto words = client.read_registers(inputs, requests, 42);  // counts itself
  std::vector<std::uint32_t> counters;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    counters.push_back(std::uint32_t{words[i]} << 16U | words[i + 1]);
  }
  const std::vector<std::uint32_t> all{21, 5, 2, 0, 2, 0, 0, 0};
  const std::vector<std::uint32_t> by_function{3, 3, 10, 1, 1, 0, 0, 0, 3, 0, 0, 0, 0};
  EXPECT_EQ(std::vector(counters.begin(), counters.begin() + 8), all);
  EXPECT_EQ(std::vector(counters.begin() + 8, counters.end()), by_function);
}

TEST(ServeCounters, OfOpenConnectionsFallAgain) {
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  ModbusClient client = server.connect();
  constexpr std::uint16_t open_connections = requests + 8;
  const auto open_now = [&] { return client.read_registers(inputs, open_connections, 2).at(1); };
  {
    ModbusClient other = server.connect();
    (void)other.read_registers(inputs, 0, 1);
    EXPECT_EQ(open_now(), 2);
  }
  const auto end = std::chrono::steady_clock::now() + test::time_to_end;
  while (open_now() != 1 && std::chrono::steady_clock::now() < end) {
  }
  EXPECT_EQ(open_now(), 1);
}

TEST(ServeCounters, OfRefusedConnectionsTellThoseWithoutPermission) {
  // Asked over the serial line, since nobody may connect.
  const ServeProcess server(
      Program(), {triangle, "--format", "json", "--log-level", "error", "--tcp", "127.0.0.1:0",
                  "--rtu", "pty", "--allow", "10.0.0.0/8"});
  const test::Descriptor stranger(test::connect_to(server.tcp()));
  ASSERT_TRUE(stranger.is_readable_within(test::time_to_end));
  char byte = 0;
  EXPECT_LE(read(stranger.number(), &byte, 1), 0);  // closed
  ModbusClient client(DeviceUrl::parse("modbus-rtu:" + server.rtu() + "?parity=none"),
                      std::chrono::seconds(10));
  EXPECT_EQ(client.read_registers(inputs, requests + 4, 4),
            (std::vector<std::uint16_t>{0, 0, 0, 1}));
}

}  // namespace
}  // namespace gonio

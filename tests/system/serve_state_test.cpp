#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "tests/system/serve_process.hpp"

// Settings over power off.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using modbus::Table;
using test::Program;
using test::quietly;
using test::ServeProcess;
using test::triangle;

constexpr std::uint16_t command = 1000, save_settings = 8, command_error = 10;
constexpr std::uint16_t statistics_readings = 1003, reference = 1008;

std::vector<std::uint16_t> settings_of(ModbusClient& client) {
  return client.read_registers(Table::holding_registers, statistics_readings, 29);
}

/// A server that keeps its settings in the folder of the program.
std::vector<std::string> keeping(const Program& program) {
  return quietly({triangle, "--tcp", "127.0.0.1:0", "--state", (program.folder() / "s").string()});
}

TEST(ServedSettings, ThatAreSavedSurviveTheEndAndACrash) {
  const Program program;
  std::vector<std::uint16_t> saved;
  for (const int signal : {SIGTERM, SIGKILL}) {
    ServeProcess server(program, keeping(program));
    ModbusClient client = server.connect();
    const bool is_first = saved.empty();
    if (!is_first) {
      EXPECT_EQ(settings_of(client), saved);
    }
    client.write_registers(statistics_readings, {static_cast<std::uint16_t>(is_first ? 17 : 18)});
    client.write_registers(reference, {0x4228, 0x3333});  // 42.05
    client.write_registers(command, {save_settings});
    saved = settings_of(client);
    EXPECT_EQ(server.end(signal), signal == SIGTERM ? 0 : 128 + SIGKILL);
  }
  const ServeProcess server(program, keeping(program));
  ModbusClient client = server.connect();
  EXPECT_EQ(settings_of(client), saved);
  EXPECT_EQ(saved.at(0), 18);
}

TEST(ServedSettings, ThatAreNotSavedAreLost) {
  const Program program;
  std::vector<std::uint16_t> at_first;
  {
    ServeProcess server(program, keeping(program));
    ModbusClient client = server.connect();
    at_first = settings_of(client);
    client.write_registers(statistics_readings, {17});
    EXPECT_NE(settings_of(client), at_first);
    EXPECT_EQ(server.end(), 0);
  }
  const ServeProcess server(program, keeping(program));
  ModbusClient client = server.connect();
  EXPECT_EQ(settings_of(client), at_first);
}

/// Saving fails, and says so. @pre  `client` is that of a server that cannot save.
void expect_that_saving_fails(ModbusClient& client) {
  client.write_registers(command, {save_settings});
  EXPECT_EQ(client.read_registers(Table::input_registers, command_error, 1).front(),
            static_cast<std::uint16_t>(DeviceError::storage_failed));
}

TEST(ServedSettings, CannotBeSavedWithoutAFolder) {
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  ModbusClient client = server.connect();
  expect_that_saving_fails(client);
}

TEST(ServedSettings, CannotBeSavedInAFolderThatIsGone) {
  const Program program;
  const ServeProcess server(program, keeping(program));
  ModbusClient client = server.connect();
  fs::remove_all(program.folder() / "s");
  expect_that_saving_fails(client);
  EXPECT_FALSE(fs::exists(program.folder() / "s"));
}

TEST(ServedSettings, OfAFileThatIsDamagedAreRefusedAtTheirPlace) {
  const Program program;
  std::vector<std::string> arguments = keeping(program);
  arguments.insert(arguments.begin(), "serve");
  fs::create_directory(program.folder() / "s");
  const fs::path file =
      program.file("s/triangle_gloss_1.yaml", "schema: gonio/settings/1\nmode: singular\n");
  const test::Outcome outcome = program.run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::StartsWith(file.string() + ":2:7: mode: expected one of"));
}

}  // namespace
}  // namespace gonio

#include "tests/conformance/modbus_port.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/assembly.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/protocol/device_dialogue.hpp"
#include "tests/system/serve_process.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using std::chrono::milliseconds;
using test::message_of;
using test::Program;
using test::ServeProcess;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double tolerance_gu = 1e-4;  // as `gonio serve` asks for
const std::vector<std::string> samples{"red_satin", "black_glass_n1567", "perfect_mirror"};

/// triangle_gloss with three samples, at a free port.
class Served {
 public:
  explicit Served(const std::vector<std::string>& more = {"--ideal"})
      : process_(program_, arguments(more)) {}

  [[nodiscard]] std::string url() const { return "modbus://" + process_.tcp(); }
  [[nodiscard]] ModbusClient client() const { return process_.connect(); }
  void kill() { (void)process_.end(SIGKILL); }
  /// From now on it answers no request, `count` times; 0: for ever.
  void fall_silent(std::uint16_t count) {
    ModbusClient other = client();
    const std::uint16_t no_reply = 1, every = 0xFFFF, add = 1;
    other.write_registers(known_point("wire_fault").address,
                          {no_reply, every, every, 0, every, count});
    other.write_registers(known_point("wire_fault_apply").address, {add});
  }

 private:
  static std::vector<std::string> arguments(const std::vector<std::string>& more) {
    std::vector<std::string> result = test::quietly({test::triangle, "--tcp", "127.0.0.1:0"});
    for (const std::string& sample : samples) {
      result.insert(result.end(), {"--sample", sample});
    }
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  Program program_;
  ServeProcess process_;
};

/// The same device in process.
Device ideal_device() {
  const Catalog catalog({test::source_tree});
  const Instrument instrument =
      load_instrument(catalog.find(Catalog::Kind::instrument, test::triangle), catalog);
  const WavelengthGrid grid = WavelengthGrid::visible();
  std::vector<Sample> laid_out;
  for (const std::string& id : samples) {
    laid_out.push_back(load_sample(catalog.find(Catalog::Kind::sample, id), grid));
  }
  return assemble_device({instrument, grid, std::make_shared<ApertureIntegrator>()},
                         instrument.behaviour.ideal(), laid_out, tolerance_gu);
}

ModbusPort::Options impatient() {
  return {.timeout = milliseconds(300),
          .short_timeout = milliseconds(100),
          .search_budget = milliseconds(200)};
}

double seconds_of(const std::function<void()>& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(ModbusPort, TellsWhoTheDeviceIsAndWhatItHas) {
  const Served served;
  ModbusPort port(served.url(), {});
  EXPECT_EQ(port.identity().model, "Triangle Gloss");
  EXPECT_EQ(port.identity().serial_number, "TG-2813-0042");
  EXPECT_EQ(port.where(), served.url() + "/1");
  ASSERT_EQ(port.channels().size(), 3U);
  EXPECT_EQ(port.channels()[0].theta_i, degrees(20));
  EXPECT_EQ(port.channels()[2].theta_i, degrees(85));
  EXPECT_EQ(port.channels()[1].tile_assigned_gu, 100.0);
}

TEST(ModbusPort, StatesTheSetUpAsTheInstrumentFileDoes) {
  const Served served;
  ModbusPort port(served.url(), {});
  const auto theta_i = port.setup(1, SetupQuantity::theta_i);
  ASSERT_TRUE(theta_i);
  EXPECT_EQ(theta_i->value, degrees(60.04));
  EXPECT_EQ(theta_i->expanded_uncertainty, degrees(0.01));
  EXPECT_EQ(port.setup(0, SetupQuantity::source_in_plane)->value, degrees(0.72));
  EXPECT_FALSE(port.setup(0, SetupQuantity::source_diameter));
  EXPECT_FALSE(port.setup(3, SetupQuantity::theta_i));
}

void expect_same(const PortStatus& found, const Device& device) {
  EXPECT_EQ(found.state, device.status().state);
  EXPECT_EQ(found.is_calibration_due, device.status().is_calibration_due);
  ASSERT_EQ(found.readings.size(), device.status().channels.size());
  for (std::size_t i = 0; i < found.readings.size(); ++i) {
    const ChannelStatus& expected = device.status().channels[i];
    EXPECT_EQ(found.readings[i].status, expected.reading.status) << i;
    EXPECT_FLOAT_EQ(float(found.readings[i].gloss_gu), float(expected.reading.gloss_gu)) << i;
    EXPECT_EQ(found.statistics[i].n, expected.statistics.n) << i;
    EXPECT_FLOAT_EQ(float(found.statistics[i].mean), float(expected.statistics.mean)) << i;
    EXPECT_FLOAT_EQ(float(found.statistics[i].minimum), float(expected.statistics.minimum)) << i;
    EXPECT_FLOAT_EQ(float(found.statistics[i].standard_deviation),
                    float(expected.statistics.standard_deviation))
        << i;
  }
}

TEST(ModbusPort, ShowsWhatTheDeviceInProcessShows) {
  const Served served;
  ModbusPort port(served.url(), {});
  Device device = ideal_device();
  const auto run = [&](DeviceCommand command) {
    EXPECT_EQ(port.command(command), DeviceError::none);
    EXPECT_TRUE(device.command(command));
    device.advance(20.0);
  };
  expect_same(port.status(), device);
  port.place(PortCover::tile);
  device.place(PortCover::tile);
  run(DeviceCommand::calibrate);
  for (const int sample : {1, 0, 2}) {
    port.place(PortCover::sample, samples[std::size_t(sample)]);
    device.place(PortCover::sample, sample);
    run(DeviceCommand::measure);
    expect_same(port.status(), device);  // the mirror is over range
  }
  run(DeviceCommand::clear_statistics);
  expect_same(port.status(), device);
}

TEST(ModbusPort, TellsWhyTheDeviceRefuses) {
  const Served served;
  ModbusPort port(served.url(), {});
  port.place(PortCover::nothing);
  EXPECT_EQ(port.command(DeviceCommand::calibrate), DeviceError::not_on_tile);
  EXPECT_EQ(port.command(DeviceCommand::zero), DeviceError::not_on_trap);
  EXPECT_EQ(port.command(DeviceCommand::save_settings), DeviceError::storage_failed);
  EXPECT_EQ(port.command(DeviceCommand::none), DeviceError::unknown_command);
  const Served cold(std::vector<std::string>{});
  ModbusPort cold_port(cold.url(), {});
  EXPECT_EQ(cold_port.status().state, DeviceState::warm_up);
  EXPECT_EQ(cold_port.command(DeviceCommand::measure), DeviceError::warming_up);
}

TEST(ModbusPort, TellsThatTheDeviceIsBusyWithSomethingElse) {
  const Served served({"--ideal", "--place", "red_satin"});
  ModbusClient other = served.client();
  const std::uint16_t continuous = 2, measure = 1;
  other.write_registers(known_point("mode").address, {continuous});
  other.write_registers(known_point("command").address, {measure});
  ModbusPort port(served.url(), {});
  EXPECT_EQ(port.command(DeviceCommand::calibrate), DeviceError::busy);
  EXPECT_EQ(port.command(DeviceCommand::stop), DeviceError::none);
}

TEST(ModbusPort, LosesADeviceWhoseCommandDoesNotEnd) {
  const Served served({"--ideal", "--place", "red_satin"});
  const std::uint16_t continuous = 2;
  served.client().write_registers(known_point("mode").address, {continuous});
  ModbusPort port(served.url(), {.command_limit = milliseconds(200)});
  EXPECT_THAT(message_of([&] { (void)port.command(DeviceCommand::measure); }),
              HasSubstr("command measure: expected an end within 0.2 s, found it running"));
}

TEST(ModbusPort, LaysNoSampleThatTheDeviceHasNot) {
  const Served served({"--ideal", "--place", "perfect_mirror"});
  ModbusPort port(served.url(), {});
  EXPECT_THROW(port.place(PortCover::sample, "unobtainium"), NotOffered);
  ModbusClient client = served.client();
  const DeviceView view(client, points_of_blocks({"simulation"}));
  EXPECT_EQ(view.text("sample_id"), "perfect_mirror");  // as it was
}

TEST(ModbusPort, AsksAPersonToLaySomethingOnAPortThatNobodySimulates) {
  const Served served({"--ideal", "--no-simulation"});
  std::vector<std::string> asked;
  bool is_willing = true;
  ModbusPort port(served.url(), {.ask = [&](const std::string& what) {
                    asked.push_back(what);
                    return is_willing;
                  }});
  port.place(PortCover::sample, "blue_tile");
  EXPECT_EQ(asked.back(),
            "Lay the sample 'blue_tile' on the measuring port of gonio Triangle Gloss, serial "
            "number TG-2813-0042.");
  is_willing = false;
  EXPECT_THROW(port.place(PortCover::tile), NotOffered);
  ModbusPort alone(served.url(), {});
  EXPECT_THAT(message_of([&] { alone.place(PortCover::black_trap); }),
              StartsWith("nobody lays the black trap on the port of modbus://"));
}

TEST(ModbusPort, LosesADeviceThatHasNotThisRegisterMap) {
  const Served served;
  EXPECT_THAT(message_of([&] { ModbusPort(served.url() + "/99", {}); }), HasSubstr("/99: read "));
  EXPECT_THROW(ModbusPort(served.url() + "/99", {}), DeviceLost);
  EXPECT_THROW(ModbusPort("modbus:/nonsense", {}), std::invalid_argument);
}

TEST(ModbusPort, LosesADeviceThatIsSwitchedOff) {
  Served served;
  ModbusPort port(served.url(), impatient());
  served.kill();
  EXPECT_THAT(message_of([&] { (void)port.status(); }),
              testing::AllOf(StartsWith("read its registers: modbus://127.0.0.1:"),
                             HasSubstr("read input registers 0 to 71")));
  constexpr double without_a_wait_s = 1.0;
  EXPECT_LT(seconds_of([&] {
              for (int i = 0; i < 100; ++i) {
                EXPECT_THROW((void)port.command(DeviceCommand::measure), DeviceLost);
              }
            }),
            without_a_wait_s);
  EXPECT_THROW(ModbusPort(served.url(), impatient()), DeviceLost);
}

TEST(ModbusPort, GivesUpADeviceThatNeverAnswersAgain) {
  Served served;
  ModbusPort port(served.url(), impatient());
  served.fall_silent(0);
  constexpr double at_most_s = 3.0;  // a timeout, and what is spent on the search
  EXPECT_LT(seconds_of([&] {
              for (int i = 0; i < 100; ++i) {
                EXPECT_THROW((void)port.status(), DeviceLost);
              }
            }),
            at_most_s);
}

TEST(ModbusPort, FindsADeviceAgainThatWasLostForAWhile) {
  Served served;
  ModbusPort port(served.url(), impatient());
  served.fall_silent(1);
  EXPECT_THROW((void)port.status(), DeviceLost);
  EXPECT_EQ(port.status().state, DeviceState::idle);
}

TEST(ModbusPort, LetsTheTimeOfAFastDevicePass) {
  const Served served({"--ideal", "--speed", "3600"});
  ModbusPort port(served.url(), {});
  ModbusClient client = served.client();
  const auto uptime = [&] { return DeviceView(client, {&known_point("uptime")}).number("uptime"); };
  const double before = uptime();
  port.pass(1800.0);
  EXPECT_GE(uptime(), before + 1800.0);
}

TEST(ModbusPort, WaitsNoLongerThanItsPatience) {
  const Served served;
  ModbusPort port(served.url(), {.patience = milliseconds(2000)});
  EXPECT_THAT(message_of([&] { port.pass(8 * 3600.0); }),
              "would take 8 h; allow it with --patience");
  port.pass(0.0);
}

}  // namespace
}  // namespace gonio::conformance

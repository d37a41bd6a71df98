#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/serve_fixture.hpp"

// read, trigger, watch and write: where no device is, or one with whims.

namespace gonio {
namespace {

using test::Outcome;
using test::Program;
using test::ServedInstrument;
using testing::EndsWith;
using testing::HasSubstr;

const std::string nobody = "modbus://127.0.0.1:1";  // a port that no service of a computer has

Outcome run(const std::vector<std::string>& arguments) { return Program().run(arguments); }

void expect_refused(const std::vector<std::string>& arguments, const std::string& message) {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(message));
}

// Without a device: what is wrong is found before anybody is asked.

TEST(DeviceCommand, SaysWhereNobodyAnswers) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"read", nobody},
                                             {"trigger", nobody, "measure"},
                                             {"watch", nobody},
                                             {"write", nobody, "mode=single"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 3) << command.front();
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "gonio: modbus://127.0.0.1:1/1: cannot connect: Connection refused\n");
  }
}

TEST(DeviceCommand, RefusesAUrlThatIsNone) {
  for (const char* command : {"read", "watch"}) {
    expect_refused({command, "http://host"},
                   "gonio: expected a device as modbus://HOST[:PORT][/UNIT] or "
                   "modbus-rtu:PATH[?baud=19200&parity=even&unit=1], found 'http://host'\n");
  }
  expect_refused({"read"}, "url");
  expect_refused({"read", nobody, "--timeout", "0 s"},
                 "--timeout: expected a time (s, ms, min, h) in [0.001, 600], found '0 s'");
}

TEST(ReadCommand, RefusesPointsThatAreNone) {
  expect_refused({"read", nobody, "--points", "state", "shine"},
                 "expected the id of a point, see `gonio registers`, found 'shine'");
}

TEST(WriteCommand, RefusesWhatCannotBeWritten) {
  expect_refused({"write", nobody}, "assignments");
  expect_refused({"write", nobody, "mode"}, "expected POINT=VALUE, found 'mode'");
  expect_refused({"write", nobody, "=3"}, "expected POINT=VALUE, found '=3'");
  expect_refused({"write", nobody, "shine=3"},
                 "expected the id of a point, see `gonio registers`, found 'shine'");
  expect_refused({"write", nobody, "gloss_1=3"},
                 "gloss_1: expected a point that can be written, found one that is read only");
  expect_refused({"write", nobody, "mode=fast"},
                 "mode: expected one of single, statistics, continuous, difference, pass_fail, "
                 "found 'fast'");
  expect_refused({"write", nobody, "lower_limit_60=low"},
                 "lower_limit_1: expected a number, found 'low'");
}

TEST(TriggerCommand, RefusesCommandsThatAreNone) {
  expect_refused({"trigger", nobody, "jump"}, "command: jump not in {measure,calibrate,zero,");
  expect_refused({"trigger", nobody, "none"}, "command: none not in");
  expect_refused({"trigger", nobody, "measure", "--wait", "long"},
                 "--wait: expected a time (s, ms, min, h) in [0, 86400], found 'long'");
}

TEST(WatchCommand, RefusesBadOptions) {
  expect_refused({"watch", nobody, "--interval", "0"},
                 "--interval: expected a time (s, ms, min, h) in [0.01, 86400], found '0'");
  expect_refused({"watch", nobody, "--count", "0"}, "--count");
}

// Other devices.

TEST(DeviceCommand, TalksOverASerialLine) {
  const ServedInstrument device({"--ideal", "--rtu", "pty", "--unit", "7"});
  EXPECT_EQ(run({"read", device.rtu_url() + "?unit=7", "--points", "test_int16"}).out,
            "test_int16  -12345\n");
  const Outcome other = run({"read", device.rtu_url() + "?unit=8", "--timeout", "0.1"});
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.err, EndsWith("parity=even&unit=8: read holding registers 1000 to 1031: "
                                  "Connection timed out\n"));
}

TEST(DeviceCommand, AsksAgainWhileTheDeviceIsBusy) {
  const ServedInstrument device({"--ideal", "--fault", "{fault: exception, code: 6, count: 3}"});
  EXPECT_EQ(run({"read", device.url(), "--points", "state"}).out, "state  idle\n");
}

TEST(DeviceCommand, ReportsFaultsOfTheWire) {
  struct Fault {
    std::string rule, message;
    int status;
  };
  for (const Fault& fault : std::vector<Fault>{
           {"exception, code: 11",
            "the device answered with exception 0B, no answer behind the gateway", 1},
           {"wrong_transaction", "Invalid data", 3},
           {"close", "Connection reset by peer", 3},
           {"no_reply", "Connection timed out", 3},
           {"truncated", "Connection timed out", 3}}) {
    const ServedInstrument device({"--ideal", "--fault", "{fault: " + fault.rule + ", count: 1}"});
    const std::vector<std::string> read{"read",  device.url(), "--points",
                                        "state", "--timeout",  "100 ms"};
    const Outcome outcome = run(read);
    EXPECT_EQ(outcome.status, fault.status) << fault.rule;
    EXPECT_EQ(outcome.err,
              "gonio: " + device.url() + "/1: read input register 1: " + fault.message + "\n");
    EXPECT_EQ(run(read).out, "state  idle\n") << fault.rule;
  }
}

TEST(DeviceCommand, ShowsADeviceThatHidesItsSimulation) {
  const ServedInstrument device({"--ideal", "--no-simulation"});
  const Outcome outcome = run({"read", device.url()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("On the port")));
}

TEST(DeviceCommand, ShowsAReadingOverRange) {
  const ServedInstrument device(
      {"--ideal", "--place", "tile", "--fault", "{fault: over_range, after: 0 s}"});
  EXPECT_THAT(run({"trigger", device.url(), "measure"}).out, HasSubstr("   20.00 over range\n"));
  EXPECT_EQ(run({"read", device.url(), "--points", "gloss_20"}).out, "gloss_1  over range\n");
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/serve_fixture.hpp"

// read, trigger, watch and write, with a device that is ideal.

namespace gonio {
namespace {

using nlohmann::json;
using test::Outcome;
using test::Program;
using test::ServedInstrument;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// It has the black glass on its port, which is 100 GU by definition.

class WithAnIdealDevice : public testing::Test {
 protected:
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, device_.url());
    return Program().run(arguments);
  }
  [[nodiscard]] json run_json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out);
  }
  void expect_done(const std::vector<std::string>& arguments, const std::string& out) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, out);
    EXPECT_EQ(outcome.err, "");
  }
  void expect_no(const std::vector<std::string>& arguments, const std::string& reason) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "gonio: " + device_.url() + "/1: " + reason + "\n");
  }
  [[nodiscard]] std::string url() const { return device_.url(); }

 private:
  ServedInstrument device_{{"--ideal", "--place", "black_glass_n1567"}};
};

TEST_F(WithAnIdealDevice, ReadShowsItAsPeopleReadIt) {
  const Outcome outcome = run({"read"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              StartsWith("gonio Triangle Gloss, serial number TG-2813-0042, firmware "));
  for (const char* text :
       {"State         idle: waits for a command\n",
        "Alarms        Power was off, or the instrument was restarted\n", "Last command  none\n",
        "Mode          single: one reading\n", "On the port   sample black_glass_n1567\n",
        "Faults on     none\n", "   Angle   Gloss/GU\n   20.00          -\n"}) {
    EXPECT_THAT(outcome.out, HasSubstr(text));
  }
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("\033")));
}

TEST_F(WithAnIdealDevice, ReadShowsItAsJsonAndCsv) {
  ASSERT_EQ(run({"trigger", "measure"}).status, 0);
  const json device = run_json({"read"});
  EXPECT_EQ(device["schema"], "gonio/device/1");
  EXPECT_EQ(device["url"], url() + "/1");
  EXPECT_EQ(device["identity"]["serial_number"], "TG-2813-0042");
  EXPECT_EQ(device["state"], "idle");
  EXPECT_EQ(device["command"]["name"], "measure");
  EXPECT_EQ(device["command"]["state"], "done");
  EXPECT_EQ(device["sequence"], 1);
  EXPECT_THAT(device["status"], testing::Contains("result_valid"));
  ASSERT_EQ(device["channels"].size(), 3U);
  EXPECT_EQ(device["channels"][1]["angle_deg"], 60);
  EXPECT_EQ(device["channels"][1]["state"], "valid");
  EXPECT_EQ(device["channels"][1]["is_calibrated"], false);
  EXPECT_TRUE(device["channels"][1]["difference_gu"].is_null());
  EXPECT_EQ(device["simulation"]["sample"], "black_glass_n1567");

  const Outcome csv = run({"read", "--format", "csv"});
  EXPECT_THAT(csv.out, StartsWith("channel,angle_deg,gloss_gu,state,difference_gu,verdict,n,"));
  EXPECT_EQ(count_lines(csv.out), 4U);
  EXPECT_THAT(csv.out,
              HasSubstr("\n2,60," + device["channels"][1]["gloss_gu"].dump() + ",valid,,"));
}

TEST_F(WithAnIdealDevice, ReadsTheGlossThatMeasureComputes) {
  ASSERT_EQ(run({"write", "cover=sample", "sample=1"}).status, 0);
  ASSERT_EQ(run({"trigger", "measure"}).status, 0);
  const json shown = run_json({"read", "--points", "gloss_20", "gloss_60", "gloss_85"});
  const Outcome computed = Program().run(
      {"measure", "--instrument", "triangle_gloss", "--sample", "red_satin", "--format", "json"});
  const json geometries = json::parse(computed.out)["geometries"];
  ASSERT_EQ(geometries.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(shown["points"][i]["value"].get<float>(), geometries[i]["gloss_gu"].get<float>());
  }
}

TEST_F(WithAnIdealDevice, ReadShowsPointsThatWereAskedFor) {
  const Outcome text = run({"read", "--points", "state", "gloss_60", "test_float", "sample_id"});
  EXPECT_EQ(text.out,
            "state       idle\n"
            "gloss_2     -\n"
            "test_float  -123.45\n"
            "sample_id   black_glass_n1567\n");
  EXPECT_EQ(run({"read", "--points", "theta_i_60", "theta_i_uncertainty_60"}).out,
            "theta_i_2              60.04 deg\ntheta_i_uncertainty_2  0.01 deg\n");
  EXPECT_EQ(run({"read", "--points", "interval", "gloss_1", "--format", "csv"}).out,
            "id,value,unit\ninterval,1,s\ngloss_1,,GU\n");
  const json points = run_json({"read", "--points", "gloss_1", "state", "test_int32"})["points"];
  EXPECT_TRUE(points[0]["value"].is_null());
  EXPECT_EQ(points[1]["value"], "idle");
  EXPECT_EQ(points[2]["value"], -123456789);
}

TEST_F(WithAnIdealDevice, TriggerMeasureShowsTheReading) {
  const Outcome outcome = run({"trigger", "measure"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex("   Angle   Gloss/GU.*\n"
                                                  "   20.00 +(99|100)\\.[0-9][0-9]"));
  EXPECT_EQ(run_json({"read"})["sequence"], 1);
}

TEST_F(WithAnIdealDevice, TriggerTellsTheReasonWhenItSaysNo) {
  expect_no({"trigger", "calibrate"},
            "calibrate: not_on_tile: Does not lie on the calibration tile");
  expect_no({"trigger", "store_reference"},
            "store_reference: no_reading: No reading that could become the reference");
}

TEST_F(WithAnIdealDevice, TriggerCalibratesOnTheTile) {
  expect_done({"write", "cover=tile"}, "");
  expect_done({"trigger", "calibrate"}, "calibrate: done\n");
  EXPECT_EQ(run_json({"read"})["channels"][0]["is_calibrated"], true);
  expect_done({"trigger", "acknowledge_alarms"}, "acknowledge_alarms: done\n");
  EXPECT_TRUE(run_json({"read"})["alarms"].empty());
}

TEST_F(WithAnIdealDevice, TriggerEndsWhenTheCommandDoesNot) {
  expect_done({"write", "mode=continuous", "interval=3600"}, "");
  expect_no({"trigger", "measure", "--wait", "100 ms"},
            "measure: still running; see `gonio watch`");
  expect_no({"trigger", "zero", "--wait", "0"},
            "write holding register 1000: the device answered with exception 06, device busy");
  expect_done({"trigger", "stop"}, "stop: done\n");
}

TEST_F(WithAnIdealDevice, TriggerWithoutWaitingReturnsAtOnce) {
  expect_done({"trigger", "measure", "--wait", "0"}, "measure: accepted\n");
}

TEST_F(WithAnIdealDevice, TriggerRestartsIt) {
  expect_done({"trigger", "restart"}, "restart: done\n");
}

TEST_F(WithAnIdealDevice, WriteTakesSettingsBySymbolAndAngle) {
  expect_done({"write", "upper_limit_60=90", "mode=pass_fail", "lower_limit_60=80.5",
               "measured_channels=channel_1+channel_2"},
              "");
  const json device = run_json({"read"});
  EXPECT_EQ(device["mode"], "pass_fail");
  EXPECT_EQ(device["channels"][1]["lower_limit_gu"], 80.5);
  EXPECT_EQ(device["channels"][1]["upper_limit_gu"], 90);
  EXPECT_EQ(device["channels"][0]["upper_limit_gu"], 2000);
  EXPECT_EQ(run({"read", "--points", "measured_channels"}).out,
            "measured_channels  channel_1+channel_2\n");
}

TEST_F(WithAnIdealDevice, WriteStartsCommandsByCoils) {
  expect_done({"write", "run_measure=true"}, "");
  EXPECT_EQ(run_json({"read"})["sequence"], 1);
}

TEST_F(WithAnIdealDevice, WriteOfAdjoiningPointsIsAllOrNothing) {
  expect_no({"write", "mode=statistics", "statistics_readings=5000"},
            "write holding registers 1002 to 1003: the device answered with exception 03, illegal "
            "data value");
  EXPECT_EQ(run_json({"read"})["mode"], "single");
}

TEST_F(WithAnIdealDevice, WriteRefusesTheSamePointTwiceAndAnglesItHasNot) {
  const Outcome twice = run({"write", "lower_limit_60=1", "lower_limit_2=2"});
  EXPECT_EQ(twice.status, 2);
  EXPECT_EQ(twice.err, "gonio: lower_limit_2: expected each point once, found it twice\n");
  const Outcome angle = run({"write", "lower_limit_45=1"});
  EXPECT_EQ(angle.status, 2);
  EXPECT_EQ(angle.err,
            "gonio: lower_limit_45: expected one of the angles 20, 60, 85, found '45'\n");
}

TEST_F(WithAnIdealDevice, WatchWritesALineEachTimeWhenPiped) {
  const Outcome text = run({"watch", "--count", "2", "--interval", "10 ms"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_EQ(count_lines(text.out), 2U);
  EXPECT_THAT(text.out, EndsWith("Z  #0 idle  20 deg -  60 deg -  85 deg -\n"));

  ASSERT_EQ(run({"trigger", "measure"}).status, 0);
  const Outcome csv = run({"watch", "--count", "2", "--interval", "10ms", "--format", "csv"});
  EXPECT_EQ(count_lines(csv.out), 3U);
  EXPECT_THAT(csv.out, StartsWith("time,sequence,state,gloss_20_gu,state_20,gloss_60_gu,state_60,"
                                  "gloss_85_gu,state_85\n"));
  EXPECT_THAT(csv.out, testing::ContainsRegex("Z,1,idle,[0-9.]+,valid,"));

  const json line = run_json({"watch", "--count", "1"});
  EXPECT_EQ(line["sequence"], 1);
  EXPECT_EQ(line["channels"][2]["angle_deg"], 85);
  EXPECT_EQ(line["channels"][2]["state"], "valid");
}

TEST_F(WithAnIdealDevice, WatchEndsCleanlyOnCtrlCWhenPiped) {
  const Program program;
  const test::Pipe pipe;
  const pid_t watch = program.start({"watch", url(), "--interval", "1 h"}, pipe.in());
  EXPECT_THAT(test::read_until(pipe.out(), "\n"), HasSubstr("#0 idle"));
  kill(watch, SIGINT);
  EXPECT_EQ(Program::wait(watch), 0);
}

TEST_F(WithAnIdealDevice, WatchDrawsOnATerminalAndRestoresItsCursorOnCtrlC) {
  ASSERT_EQ(run({"trigger", "measure"}).status, 0);
  int ours = -1, theirs = -1;
  ASSERT_EQ(openpty(&ours, &theirs, nullptr, nullptr, nullptr), 0);
  const Program program;
  const pid_t watch = program.start({"watch", url(), "--interval", "10 ms"}, theirs);
  const std::string first = test::read_until(ours, "\033[5A\r");  // goes back to draw again
  kill(watch, SIGINT);
  const std::string last = test::read_until(ours, "\033[?25h\033[?7h");
  EXPECT_EQ(Program::wait(watch), 0);
  close(theirs);
  close(ours);
  EXPECT_THAT(first, StartsWith("\033[?25l\033[?7l"));
  EXPECT_THAT(first, HasSubstr(url() + "/1  idle  reading 1"));
  EXPECT_THAT(first, HasSubstr("▅  "));
  EXPECT_THAT(last, EndsWith("\033[?25h\033[?7h"));
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using test::contents;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

/// A quick scan: few positions and wavelengths.
std::vector<std::string> quick(std::vector<std::string> more) {
  std::vector<std::string> arguments{"scan",          "--sample",      "red_satin",
                                     "--theta-i",     "45 deg",        "--theta-r",
                                     "-80:80:10 deg", "--wavelengths", "500:600:50"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(ScanCommand, TellsThePeaks) {
  const Outcome outcome = Program().run(quick({}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("17: 15 measured, 0 known by reciprocity, 2 out of reach"));
  EXPECT_THAT(outcome.out, HasSubstr("circle 1 deg"));
}

TEST(ScanCommand, WritesEachPositionAsCsv) {
  const Program program;
  const Outcome outcome = program.run(quick({"--format", "csv", "--output", "scan.csv"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(contents(program.folder() / "scan.csv"), outcome.out);
  EXPECT_THAT(outcome.out, HasSubstr("\ntheta_i,rotation,theta_r,phi_r,state,omega_r,f_r,error,"
                                     "f_r_500,f_r_550,f_r_600,flux_500,flux_550,flux_600\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n45,0,-50,0,blocked,"));
  EXPECT_THAT(outcome.out, HasSubstr("# receptor solid angle: "));
}

TEST(ScanCommand, WritesJsonOfItsSchema) {
  const Program program;
  const Outcome outcome = program.run(quick({"--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["schema"], "gonio/scan_result/1");
  ASSERT_EQ(json["positions"].size(), 17U);
  EXPECT_EQ(json["positions"][0]["f_r"].size(), 3U);
  EXPECT_EQ(json["evaluations"], 15);
  EXPECT_GT(json["receptor_aperture"]["solid_angle_sr"], 0.0);
}

TEST(ScanCommand, WritesWhatItsReadersRead) {
  const Program program;
  for (const char* format : {"astm", "rgl"}) {
    const Outcome outcome =
        program.run({"scan", "--sample", "red_satin", "--theta-i", "0:75:15 deg", "--theta-r",
                     "0:80:5 deg", "--phi-r", "0:345:15 deg", "--wavelengths", "500:600:50",
                     "--output", "scan", "--as", format});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const Outcome read = program.run({"convert", "scan"});
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_NE(read.out, "");
  }
}

TEST(ScanCommand, MakesAPage) {
  const Program program;
  const Outcome outcome = program.run(quick({"--report", "page"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(contents(program.folder() / "page/scan.html"), HasSubstr("<svg"));
  EXPECT_THAT(contents(program.folder() / "page/scan.json"), HasSubstr("gonio/scan_result/1"));
  EXPECT_THAT(contents(program.folder() / "page/scan.csv"), HasSubstr("theta_i,rotation"));
}

struct Misused {
  std::vector<std::string> arguments;
  const char* message;
};

class ScanMisuse : public testing::TestWithParam<Misused> {};

TEST_P(ScanMisuse, IsToldAndWritesNothing) {
  const Outcome outcome = Program().run(quick(GetParam().arguments));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, ScanMisuse,
    testing::Values(
        Misused{{"--plan", "no_such"}, "no_such: expected a scan file"},
        Misused{{"--phi-r", "20"}, "--phi-r: expected angles in [-360, 360] deg"},
        Misused{{"--rotation", "0:720:1 deg"}, "--rotation: expected angles"},
        Misused{{"--source-aperture", "0 deg"}, "--source-aperture: expected full angles"},
        Misused{{"--instrument", "paper_setup"}, "--geometry: expected both or none"},
        Misused{{"--instrument", "paper_setup", "--geometry", "61"}, "has no geometry '61'"},
        Misused{{"--patches", "64"}, "--patches: expected --integrator patches with it"},
        Misused{{"--as", "csv"}, "--as: expected --output with it"},
        Misused{{"--heads-apart", "91 deg"}, "--heads-apart: expected angles"},
        Misused{{"--receptor-aperture", "2 deg", "--reciprocal"}, "other apertures"},
        Misused{{"--rotation", "0:359.9:0.1 deg", "--phi-r", "0:359:1 deg"},
                "22032000 positions at 3 wavelengths were asked for"}));

TEST(ScanCommand, NeedsASampleThatCoversTheWavelengths) {
  const Outcome outcome = Program().run({"scan", "--sample", "copper_polished", "--wavelengths",
                                         "100:110:10", "--source-aperture", "2 deg"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("d65.csv"));
}

}  // namespace
}  // namespace gonio

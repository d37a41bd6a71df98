#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using test::contents;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

std::string brdf(const std::string& name) {
  return (test::source_tree / "fixtures/brdf" / name).string();
}

TEST(Convert, TellsWhatAFileIs) {
  const Program program;
  const Outcome outcome = program.run({"convert", brdf("satin_rosaline.zemax.bsdf")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Zemax"));
  EXPECT_THAT(outcome.out, HasSubstr("Luminance"));
  const Outcome json = program.run({"convert", brdf("satin_rosaline.astm"), "--format", "json"});
  const auto told = nlohmann::json::parse(json.out);
  EXPECT_EQ(told["schema"], "gonio/brdf/1");
  EXPECT_EQ(told["format"], "ASTM E1392");
  EXPECT_EQ(told["channels"], nlohmann::json({"R", "G", "B"}));
  EXPECT_EQ(told["warnings"].size(), 1u);  // its grid is too coarse for 75 degrees
}

TEST(Convert, WritesSamplesOfAnAstmFileAsTheyStand) {
  const Program program;
  EXPECT_EQ(program.run({"convert", brdf("satin_rosaline.astm"), "a.astm", "--to", "astm"}).status,
            0);
  EXPECT_EQ(program.run({"convert", "a.astm", "b.astm", "--to", "astm"}).status, 0);
  const std::string first = contents(program.folder() / "a.astm");
  EXPECT_THAT(first, HasSubstr("NUM_POINTS 1105\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n"));
  EXPECT_EQ(contents(program.folder() / "b.astm"), first);
}

TEST(Convert, ResamplesOtherFormats) {
  const Program program;
  const Outcome outcome = program.run({"convert", brdf("satin_rosaline_rgb.bsdf"), "a.astm", "--to",
                                       "astm", "--theta-i", "20,60", "--channels", "luminance"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(contents(program.folder() / "a.astm"), HasSubstr("theta_s,phi_s,Luminance\n"));
  EXPECT_THAT(program.run({"convert", "a.astm"}).out, HasSubstr("60 deg"));
}

TEST(Convert, WritesRgl) {
  const Program program;
  const Outcome outcome =
      program.run({"convert", brdf("satin_rosaline_rgb.bsdf"), "a.bsdf", "--to", "rgl"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string after = program.run({"convert", "a.bsdf"}).out;
  EXPECT_THAT(after, HasSubstr("RGL"));
  EXPECT_THAT(after, HasSubstr("R, G, B"));
}

TEST(Convert, RefusesWhatItCannotDo) {
  const Program program;
  (void)program.file("a.astm", "VARS theta_i,theta_s,f\n0,0,x\n");
  (void)program.file("b.txt", "no BRDF\n");
  const auto error_of = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = program.run(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_THAT(error_of({"convert", "a.astm"}), HasSubstr("a.astm:2:5: expected"));
  EXPECT_THAT(error_of({"convert", "b.txt"}), HasSubstr("RGL .bsdf, MERL .binary, ASTM E1392"));
  EXPECT_THAT(error_of({"convert", "a.astm", "out"}), HasSubstr("--to astm"));
  EXPECT_THAT(error_of({"convert", "a.astm", "--to", "astm"}), HasSubstr("OUTPUT"));
  EXPECT_THAT(error_of({"convert", "a.astm", "--step", "1"}), HasSubstr("are of --to"));
  const std::string file = brdf("satin_rosaline.astm");
  EXPECT_THAT(error_of({"convert", file, "x", "--to", "astm", "--channels", "550nm"}),
              HasSubstr("found '550nm'"));
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "x"));
}

TEST(Convert, DoesNotWriteOverItsInput) {
  const Program program;
  const std::string text = "VARS theta_i,theta_s,f\n0,0,1\n";
  (void)program.file("a.astm", text);
  const Outcome outcome = program.run({"convert", "a.astm", "./a.astm", "--to", "astm"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("expected another file than the input"));
  EXPECT_EQ(contents(program.folder() / "a.astm"), text);
}

}  // namespace
}  // namespace gonio

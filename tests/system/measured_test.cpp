#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.hpp"

// Samples whose BRDF was measured, through the whole program.

namespace gonio {
namespace {

using nlohmann::json;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

TEST(MeasureMeasured, ReadsTheGlossOfTheSatinFilm) {
  const Outcome outcome = Program().run(
      {"measure", "--sample", "satin_film_measured", "--geometry", "60", "--format", "json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json measurement = json::parse(outcome.out);
  constexpr double asked_gu = 0.5;
  EXPECT_NEAR(measurement.at("geometries").at(0).at("gloss_gu").get<double>(), 37.6, asked_gu);
}

TEST(MeasureMeasured, ReadsTheGlossOfTheWallPaint) {
  const Outcome outcome = Program().run(
      {"measure", "--sample", "wall_paint_measured", "--geometry", "60", "--format", "json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  constexpr double asked_gu = 0.1;
  EXPECT_NEAR(json::parse(outcome.out).at("geometries").at(0).at("gloss_gu").get<double>(), 1.1,
              asked_gu);
}

/// A table in steps of 5 deg cannot show a lobe of a few degrees.
TEST(MeasureMeasured, SaysWhatACoarseTableMayCost) {
  const Program program;
  const auto table = test::source_tree / "fixtures/brdf/satin_rosaline.astm";
  (void)program.file(
      "mine.yaml", test::sample_text("surface: {model: measured, file: " + table.string() + "}\n"));
  const Outcome outcome =
      program.run({"measure", "--sample", "mine.yaml", "--geometry", "20", "--format", "json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(json::parse(outcome.out).at("warnings").at(0).get<std::string>(),
              HasSubstr("coarse for the lobe it shows: the gloss may be off by about"));
  EXPECT_THAT(outcome.err, HasSubstr("gonio: mine: at 20: the BRDF was measured in steps of"));
}

TEST(MeasureMeasured, SaysThat85DegLieBeyondTheData) {
  const Outcome outcome =
      Program().run({"measure", "--sample", "wall_paint_measured", "--geometry", "85"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("what is beyond is guessed"));
}

}  // namespace
}  // namespace gonio

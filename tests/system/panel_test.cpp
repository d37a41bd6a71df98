#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

// Samples that are not the same everywhere, through the whole program.

namespace gonio {
namespace {

using nlohmann::json;
using test::Outcome;
using test::Program;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> striped{"measure", "--sample", "black_high_gloss_striped",
                                       "--instrument", "triangle_gloss"};

std::string error_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

TEST(MeasurePosition, IsToldWithSpotsAndRegionsInJson) {
  const Outcome outcome =
      Program().run(test::with(striped, {"--position", "85 mm, 50 mm", "--format", "json"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json measurement = json::parse(outcome.out);
  EXPECT_EQ(measurement.at("position"), json({{"x_mm", 85.0}, {"y_mm", 50.0}}));
  const json& spot = measurement.at("geometries").at(0).at("spot");
  EXPECT_NEAR(spot.at("length_mm").get<double>(), 10.0, 0.05);
  EXPECT_NEAR(spot.at("width_mm").get<double>(), 10.0, 0.05);
  EXPECT_EQ(spot.at("regions").at(0).at("id"), "base");
  EXPECT_EQ(spot.at("regions").at(1).at("id"), "stripe");
  EXPECT_NEAR(spot.at("regions").at(1).at("share").get<double>(), 0.5, 1e-3);  // at the edge
}

TEST(MeasurePosition, IsToldBelowTheTable) {
  const Outcome outcome = Program().run(test::with(striped, {"--position", "85mm,50mm"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("\nblack_high_gloss_striped: 20 at 85 mm, 50 mm: a spot of 10.0 mm x 10.0 "
                        "mm: base 50.0 %, stripe 50.0 %\n"));
  const Outcome nominal = Program().run({"measure", "--sample", "black_high_gloss_striped"});
  EXPECT_THAT(nominal.out, HasSubstr("60 at 75 mm, 50 mm: a point: stripe 100.0 %\n"));
  const Outcome one_region = Program().run({"measure", "--sample", "clearcoat_orange_peel"});
  EXPECT_THAT(one_region.out, HasSubstr("clearcoat_orange_peel: 60 at 75 mm, 50 mm: a point\n"));
}

TEST(MeasurePosition, LeavesHomogeneousSamplesAsTheyAre) {
  const Outcome outcome = Program().run({"measure", "--sample", "black_satin", "--format", "json"});
  const json measurement = json::parse(outcome.out);
  EXPECT_FALSE(measurement.contains("position"));
  EXPECT_FALSE(measurement.at("geometries").at(0).contains("spot"));
}

TEST(MeasurePosition, ThatIsNoneIsRefused) {
  for (const std::string bad : {"75 mm", "75 mm, 50 mm, 1 mm", "75, 50", "", ",", "75 mm,",
                                "75 mm, nan mm", "75 deg, 50 mm"}) {
    EXPECT_EQ(error_of(test::with(striped, {"--position", bad})),
              "gonio: --position: expected two lengths (nm, um, mm), e.g. '75 mm, 50 mm', found '" +
                  bad + "'\n");
  }
}

TEST(MeasurePosition, OverTheEdgeIsRefused) {
  EXPECT_THAT(error_of(test::with(striped, {"--position", "4.9 mm, 50 mm"})),
              HasSubstr("the spot of geometry 20, 10 mm x 10 mm at 4.9 mm, 50 mm, hangs over the "
                        "edge of the panel of 150 mm x 100 mm"));
}

TEST(MeasurePosition, OnASampleWithoutAPanelIsRefused) {
  EXPECT_THAT(error_of({"measure", "--sample", "black_satin", "--position", "1 mm, 1 mm"}),
              HasSubstr("black_satin: a position needs a sample whose file states 'panel:'"));
}

TEST(PanelSample, WithABadMapIsRefusedAtItsPlace) {
  const Program program;
  (void)program.file("map.csv", "0, 0.1\n0, no\n");
  (void)program.file("mine.yaml",
                     test::sample_text("surface: {model: lambertian, reflectance: 0.5}\n"
                                       "panel: {length: 150 mm, width: 100 mm}\n"
                                       "maps: {diffuse_reflectance: {file: map.csv}}\n"));
  const Outcome outcome = program.run({"measure", "--sample", "mine.yaml"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "map.csv:2:4: expected a number, found 'no'\n");
}

TEST(PanelSample, IsListedLikeOthers) {
  const Outcome list = Program().run({"list", "samples"});
  EXPECT_THAT(list.out, HasSubstr("\nblack_high_gloss_striped "));
  EXPECT_THAT(list.out, HasSubstr("\nclearcoat_orange_peel "));
}

}  // namespace
}  // namespace gonio

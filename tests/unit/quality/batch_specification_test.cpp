#include "emulator/quality/batch_specification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/quality/batch_text.hpp"

namespace gonio {
namespace {

using testing::ElementsAre;

/// Of a text whose first line is line 1, for a standard.
Specification read(const std::string& text, const std::string& standard = "iso_2813/2014",
                   const std::string& geometries = "") {
  const auto list = geometries.empty()
                        ? std::nullopt
                        : std::optional(YamlNode::parse(geometries, "geometries.yaml"));
  return read_specification(YamlNode::parse(text, "batch.yaml"), test::shipped_standard(standard),
                            list);
}

std::string error_of(const std::string& text, const std::string& standard = "iso_2813/2014",
                     const std::string& geometries = "") {
  return test::message_of([&] { (void)read(text, standard, geometries); });
}

/// Each as id(geometry)unit.
std::vector<std::string> channels(const Specification& specification) {
  std::vector<std::string> ids;
  for (const BatchChannel& channel : specification.channels) {
    ids.push_back(channel.id + "(" + channel.geometry + ")" + channel.unit);
  }
  return ids;
}

TEST(ReadSpecification, HasGlossChannelsInTheOrderOfTheStandard) {
  const Specification read_one = read("gloss: {85 deg: 82 to 88 GU, \"20\": \">= 40 GU\"}");
  EXPECT_THAT(channels(read_one), ElementsAre("20(20)GU", "85(85)GU"));
  ASSERT_EQ(read_one.requirements.size(), 2u);
  EXPECT_EQ(read_one.requirements[0].channel, 0u);
  EXPECT_EQ(read_one.requirements[0].limits.low, 40.0);
  EXPECT_EQ(read_one.requirements[1].channel, 1u);
  EXPECT_EQ(read_one.requirements[1].limits.high, 88.0);
  EXPECT_FALSE(read_one.selected_only);
}

TEST(ReadSpecification, HasColourThenHazeAfterGloss) {
  const Specification all = read(
      "haze: {haze_index: <= 20 GU}\n"
      "colour: {\"60\": {difference: <= 1.5, reference: {L: 40, a: 1, b: -2}}}\n"
      "gloss: {60 deg: 82 to 88 GU}\n",
      "astm_d4039/09");
  EXPECT_THAT(channels(all),
              ElementsAre("60(60)GU", "20(20)GU", "60/colour(60)", "haze_index()GU"));
  EXPECT_EQ(all.channels[2].kind, BatchChannel::Kind::colour_difference);
  EXPECT_EQ(all.channels[3].kind, BatchChannel::Kind::haze);
  ASSERT_EQ(all.requirements.size(), 3u);
  EXPECT_EQ(all.requirements[1].limits.high, 1.5);
  EXPECT_EQ(all.requirements[2].channel, 3u);
  ASSERT_EQ(all.colour_references.size(), 4u);
  EXPECT_EQ(all.colour_references[2], (std::array{40.0, 1.0, -2.0}));
  EXPECT_FALSE(all.colour_references[1]);
}

TEST(ReadSpecification, LeavesTheColourOfTheSampleFileForLater) {
  const Specification one = read("colour: {\"60\": {difference: <= 1.5}}");
  EXPECT_THAT(channels(one), ElementsAre("60(60)GU", "60/colour(60)"));
  EXPECT_FALSE(one.colour_references.at(1));
}

TEST(ReadSpecification, ReadsMoreThanNeedBeIfAsked) {
  const std::string gloss = "gloss: {60 deg: 82 to 88 GU}";
  EXPECT_THAT(channels(read(gloss, "iso_2813/2014", "[\"85\", 60 deg]")),
              ElementsAre("60(60)GU", "85(85)GU"));
  EXPECT_EQ(error_of(gloss, "iso_2813/2014", "[\"85\"]"),
            "geometries.yaml:1:1: expected '60' too, which the specification needs, found 'none'");
  EXPECT_EQ(error_of(gloss, "iso_2813/2014", "[\"60\", 60 deg]"),
            "geometries.yaml:1:8: [1]: expected each geometry once, found '60 deg'");
  EXPECT_EQ(error_of(gloss, "iso_2813/2014", "[\"45\"]"),
            "geometries.yaml:1:2: [0]: expected one of the geometries 20, 60, 85, found '45'");
}

TEST(ReadSpecification, MayConcernTheSelectedGeometryOnly) {
  EXPECT_TRUE(read("gloss: {\"20\": \">= 80 GU\", \"60\": 10 to 70 GU, \"85\": <= 10 GU}\n"
                   "selected_only: true")
                  .selected_only);
  EXPECT_EQ(error_of("gloss: {\"20\": \">= 80 GU\", \"60\": 10 to 70 GU}\nselected_only: true"),
            "batch.yaml:2:16: selected_only: expected limits of gloss in each geometry that may be "
            "selected: 20, 60, 85, found 'none for 85'");
  EXPECT_EQ(error_of("haze: {haze_index: <= 20 GU}\nselected_only: true", "astm_d4039/09"),
            "batch.yaml:2:16: selected_only: expected false, since astm_d4039/09 selects no "
            "geometry, found 'true'");
}

TEST(ReadSpecification, SaysWhatTheStandardHas) {
  EXPECT_EQ(error_of("gloss: {45 deg: 82 to 88 GU}"),
            "batch.yaml:1:17: gloss.45 deg: expected one of the geometries 20, 60, 85, found '45'");
  EXPECT_EQ(error_of("colour: {\"45\": {difference: <= 1}}"),
            "batch.yaml:1:16: colour.45: expected one of the geometries 20, 60, 85, found '45'");
  EXPECT_EQ(error_of("haze: {haze: <= 20 GU}"),
            "batch.yaml:1:14: haze.haze: expected a standard that has rules for haze, found "
            "'haze'");
  EXPECT_EQ(error_of("haze: {haze: <= 20 GU}", "astm_d4039/09"),
            "batch.yaml:1:14: haze.haze: expected one of the rules for haze haze_index, found "
            "'haze'");
}

TEST(ReadSpecification, NeedsLimits) {
  EXPECT_EQ(error_of("selected_only: false"),
            "batch.yaml:1:1: expected limits: one of the keys gloss, haze, colour, found 'none'");
  EXPECT_EQ(error_of("gloss: {}"),
            "batch.yaml:1:8: gloss: expected limits of one of the geometries, found 'none'");
  EXPECT_EQ(error_of("gloss: {\"60\": <= 0 GU}"),
            "batch.yaml:1:15: gloss.60: expected an upper limit > 0, found '<= 0 GU'");
  EXPECT_EQ(error_of("gloss: {\"60\": 10 to 20 GU, 60 deg: 10 to 20 GU}"),
            "batch.yaml:1:36: gloss.60 deg: expected each of them once, found '60 a second time'");
}

}  // namespace
}  // namespace gonio

#include "emulator/quality/batch_plan.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/quality/batch_text.hpp"

namespace gonio {
namespace {

constexpr PanelSize panel{.length_mm = 150.0, .width_mm = 100.0};

SamplingPlan read(const std::string& text, const std::string& standard = "iso_2813/2014") {
  return read_sampling(YamlNode::parse(text, "batch.yaml"), test::shipped_standard(standard),
                       panel);
}

std::string error_of(const std::string& text) {
  return test::message_of([&] { (void)read(text); });
}

/// As "x,y x,y".
std::string words(const std::vector<PanelPlace>& places) {
  std::ostringstream text;
  for (const PanelPlace& place : places) {
    text << (&place == places.data() ? "" : " ") << place.x_mm << ',' << place.y_mm;
  }
  return text.str();
}

TEST(ReadSampling, IsOnePanelReadAsTheStandardAsksByDefault) {
  const SamplingPlan plan = read_sampling({}, test::shipped_standard("iso_2813/2014"), panel);
  EXPECT_EQ(plan.lots, 1u);
  EXPECT_EQ(plan.panels, 1u);
  EXPECT_EQ(plan.repetitions, 1u);
  EXPECT_EQ(words(plan.positions), "25,50 75,50 125,50");
  EXPECT_EQ(plan.accept.kind, AcceptanceRule::Kind::attributes);
  EXPECT_EQ(plan.accept.nonconforming, 0u);
  EXPECT_EQ(plan.accepted_lots, 1.0);
  EXPECT_EQ(plan.acceptable_share, 0.01);
}

TEST(ReadSampling, ReadsOnceWhereTheStandardHasNoRule) {
  const SamplingPlan plan = read_sampling({}, test::shipped_standard("iso_7668/2018"), panel);
  EXPECT_EQ(words(plan.positions), "75,50");
  EXPECT_EQ(words(plan.further_positions), "");
}

TEST(ReadSampling, SpreadsPositionsEvenly) {
  EXPECT_EQ(words(read("positions: 1").positions), "75,50");
  EXPECT_EQ(words(read("positions: 5").positions), "15,50 45,50 75,50 105,50 135,50");
}

// The spot of 85 deg is long: half of it has to lie on the panel on either side.
TEST(ReadSampling, KeepsTheSpotsOfPositionsOnThePanel) {
  const PanelSize with_margin{.length_mm = 150.0, .width_mm = 100.0, .margin_mm = 20.0};
  const SamplingPlan plan = read_sampling(YamlNode::parse("positions: 2", "batch.yaml"),
                                          test::shipped_standard("iso_2813/2014"), with_margin);
  EXPECT_EQ(words(plan.positions), "47.5,50 102.5,50");
  for (const PanelPlace& place : plan.further_positions) {
    EXPECT_GE(place.x_mm, 20.0);
    EXPECT_LE(place.x_mm, 130.0);
  }
}

TEST(ReadSampling, ReadsPositionsOneByOne) {
  const SamplingPlan plan = read("positions: [[30 mm, 40 mm], [150 mm, 0 mm]]");
  EXPECT_EQ(words(plan.positions), "30,40 150,0");
}

// ISO 2813 asks for 3 readings, and for 3 more where they differ.
TEST(ReadSampling, PutsFurtherPositionsBetweenTheOthers) {
  EXPECT_EQ(words(read("positions: 3").further_positions), "50,50 100,50 12.5,50");
  EXPECT_EQ(words(read("positions: 1").further_positions),
            "37.5,50 112.5,50 18.75,50 56.25,50 93.75,50");
  EXPECT_EQ(words(read("positions: 6").further_positions), "");
  EXPECT_EQ(words(read("{positions: 3, repetitions: 2}").further_positions), "");
  EXPECT_EQ(words(read("{positions: 1, repetitions: 4}").further_positions), "37.5,50");
  EXPECT_EQ(words(read("{positions: 3, further_positions: 1}").further_positions), "50,50");
  EXPECT_EQ(words(read("{positions: 3, further_positions: 0}").further_positions), "");
  EXPECT_EQ(words(read("{further_positions: [[1 mm, 2 mm]]}").further_positions), "1,2");
}

TEST(ReadSampling, ReadsWhenALotIsAccepted) {
  EXPECT_EQ(read("{panels: 5, accept: {nonconforming_panels: 2}}").accept.nonconforming, 2u);
  EXPECT_EQ(read("accept: {mean: within_limits}").accept.kind, AcceptanceRule::Kind::mean);
  const AcceptanceRule variables = read("{panels: 2, accept: {variables: 1.5}}").accept;
  EXPECT_EQ(variables.kind, AcceptanceRule::Kind::variables);
  EXPECT_EQ(variables.k, 1.5);
  const SamplingPlan plan = read("{accepted_lots: 0.9, acceptable_share: 0}");
  EXPECT_EQ(plan.accepted_lots, 0.9);
  EXPECT_EQ(plan.acceptable_share, 0.0);
}

TEST(ReadSampling, RefusesPlansThatCannotBe) {
  EXPECT_EQ(error_of("{panels: 5, accept: {nonconforming_panels: 5}}"),
            "batch.yaml:1:44: accept.nonconforming_panels: expected fewer than the 5 panels of a "
            "lot, found '5'");
  EXPECT_EQ(error_of("accept: {variables: 1.5}"),
            "batch.yaml:1:21: accept.variables: expected a plan of 2 panels or more of each lot, "
            "found '1'");
  EXPECT_EQ(error_of("accept: {mean: low}"),
            "batch.yaml:1:16: accept.mean: expected one of within_limits, found 'low'");
  EXPECT_EQ(error_of("accept: {mean: within_limits, variables: 1}"),
            "batch.yaml:1:42: accept.variables: expected a plan of 2 panels or more of each lot, "
            "found '1'");
  EXPECT_EQ(error_of("{lots: 100000, panels: 100000}"),
            "batch.yaml:1:24: panels: expected at most 1000000000 panels of all lots together, "
            "found '10000000000'");
  EXPECT_EQ(error_of("lots: 0"),
            "batch.yaml:1:7: lots: expected a whole number in [1, 1000000000], found '0'");
  EXPECT_EQ(error_of("accepted_lots: 0"),
            "batch.yaml:1:16: accepted_lots: expected a number in (0, 1], found '0'");
  EXPECT_EQ(error_of("acceptable_share: 1"),
            "batch.yaml:1:19: acceptable_share: expected a number in [0, 1), found '1'");
}

TEST(ReadSampling, RefusesPlacesBesideThePanel) {
  EXPECT_EQ(error_of("positions: [[30 mm, 50 mm], [151 mm, 50 mm]]"),
            "batch.yaml:1:30: positions[1][0]: expected a place on the panel, from 0 mm to 150 mm, "
            "found '151 mm'");
  EXPECT_EQ(error_of("further_positions: [[30 mm, -1 mm]]"),
            "batch.yaml:1:29: further_positions[0][1]: expected a place on the panel, from 0 mm to "
            "100 mm, found '-1 mm'");
  EXPECT_EQ(error_of("positions: [[30 mm]]"),
            "batch.yaml:1:13: positions[0]: expected two lengths: along the panel and across it, "
            "found '1'");
  EXPECT_EQ(error_of("positions: 0"),
            "batch.yaml:1:12: positions: expected a whole number in [1, 1000], found '0'");
}

}  // namespace
}  // namespace gonio

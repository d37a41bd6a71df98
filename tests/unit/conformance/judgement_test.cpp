#include "tests/conformance/judgement.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio::conformance {
namespace {

using enum ConformanceVerdict;

const ClauseSet& set() {
  static const ClauseSet iso{.id = "iso_2813/2014",
                             .standard = test::shipped_standard("iso_2813/2014")};
  return iso;
}

const Clause clause{.limits = {{.quantity = "gloss",
                                .unit = "GU",
                                .nominal = 100.0,
                                .tolerance = 1.0,
                                .low = 99.0,
                                .high = 101.0}}};

Case expecting(Expectation expectation) {
  Case stated;
  stated.quantity = "gloss";
  stated.expectation = std::move(expectation);
  return stated;
}

Observation judged(const Finding& finding, Expectation expectation = {}) {
  return judge(finding, expecting(std::move(expectation)), clause, set(), DecisionRule::guarded)
      .value();
}

const Finding at_60{.geometry = "60", .unit = "GU", .value = 89.2};

TEST(Judge, TakesTheClausesLimitIfTheCaseSaysNothing) {
  EXPECT_EQ(judged({.geometry = "60", .value = 100.4}).verdict, pass);
  EXPECT_EQ(judged({.geometry = "60", .value = 101.4}).verdict, fail);
}

TEST(Judge, LaysTheClausesToleranceRoundWhatTheCaseExpects) {
  const Observation seen = judged(at_60, {.value = UnitValue{89.5, "GU"}});
  EXPECT_EQ(seen.verdict, pass);
  EXPECT_DOUBLE_EQ(*seen.low, 88.5);
  EXPECT_DOUBLE_EQ(*seen.high, 90.5);
}

TEST(Judge, PrefersTheToleranceOfTheCase) {
  EXPECT_EQ(
      judged(at_60, {.value = UnitValue{89.5, "GU"}, .tolerance = UnitValue{0.1, "GU"}}).verdict,
      fail);
}

TEST(Judge, ExpectsTheClosedFormOfAGlass) {
  const Observation seen = judged(at_60, {.value = PolishedArtefact{.index = 1.5}});
  EXPECT_TRUE(test::is_close(*seen.expected, 89.1368, 1e-4));
  EXPECT_EQ(seen.origin, "closed form of Fresnel");
  EXPECT_EQ(seen.verdict, pass);
}

TEST(Judge, ExpectsNothingOfAGeometryThatIsNotNamed) {
  const Expectation expectation{.value = Expectation::ByGeometry{{"20", {100.0, "GU"}}}};
  EXPECT_EQ(judge(at_60, expecting(expectation), clause, set(), DecisionRule::guarded),
            std::nullopt);
}

TEST(Judge, TakesUncertaintyIntoAccount) {
  Finding unsure{.geometry = "60", .value = 100.9};
  unsure.expanded_uncertainty = 0.3;
  EXPECT_EQ(judged(unsure).verdict, inconclusive);
}

TEST(Judge, ComparesWords) {
  const Expectation refused{.value = std::vector<std::string>{"warming_up", "busy"}};
  EXPECT_EQ(judged({.text = "busy"}, refused).verdict, pass);
  EXPECT_EQ(judged({.text = "none"}, refused).verdict, fail);
  EXPECT_EQ(judged({.text = "none"}, refused).expected_text, "warming_up or busy");
}

TEST(Judge, LetsADeviceBeOverRangeWhereTheValueIs) {
  Finding over{.geometry = "60", .unit = "GU", .text = "over_range"};
  over.full_scale = 1000.0;
  const Expectation mirror{.value = UnitValue{2000.0, "GU"}};
  EXPECT_EQ(judged(over, mirror).verdict, pass);
  over.full_scale = 3000.0;
  EXPECT_EQ(judged(over, mirror).verdict, fail);
  over.full_scale.reset();
  EXPECT_EQ(judged(over, mirror).verdict, fail);
}

TEST(Judge, WantsALimit) {
  const Case stated = expecting({.value = UnitValue{89.5, "GU"}});
  const Clause without{};
  EXPECT_THROW((void)judge(at_60, stated, without, set(), DecisionRule::guarded), InputError);
}

}  // namespace
}  // namespace gonio::conformance

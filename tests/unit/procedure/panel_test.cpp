#include "emulator/procedure/panel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::message_of;
using enum PanelVerdict;

constexpr double rounding = 1e-12;

const Evidence surest{.level = "C2", .sources = {"A"}};
const Evidence sure{.level = "C1", .sources = {"B"}};
const Evidence recalled{.level = "memory", .sources = {}};

ReadingRule three_readings() { return {.count = {.at_least = 3, .evidence = surest}}; }

ReadingRule rejecting() {
  ReadingRule rule = three_readings();
  rule.reject = {.range_at_least_gu = 10.0, .share_at_least = 0.2, .evidence = sure};
  return rule;
}

ReadingRule remarking() {
  ReadingRule rule = three_readings();
  rule.not_uniform = {.when_share_above = 0.05, .evidence = sure};
  return rule;
}

ReadingRule asking_for_more() {
  ReadingRule rule = three_readings();
  rule.more = {.when_range_above_gu = 5.0, .count = 3, .evidence = recalled};
  return rule;
}

TEST(PanelVerdictNames, AreThoseOfCases) {
  EXPECT_STREQ(panel_verdict_name(accepted), "accepted");
  EXPECT_STREQ(panel_verdict_name(more_readings), "more_readings");
  EXPECT_STREQ(panel_verdict_name(not_uniform), "not_uniform");
  EXPECT_STREQ(panel_verdict_name(rejected), "rejected");
}

// Statistics: the readings 2, 4, 4, 4, 5, 5, 7, 9 have mean 5 and squares of deviations of sum 32.

TEST(PanelStatistics, EqualTheirClosedForms) {
  const PanelResult panel = judge_panel({2, 4, 4, 4, 5, 5, 7, 9}, three_readings());
  EXPECT_EQ(panel.n, 8U);
  EXPECT_EQ(panel.mean_gu, 5.0);
  EXPECT_EQ(panel.range_gu, 7.0);
  EXPECT_NEAR(panel.standard_deviation_gu, std::sqrt(32.0 / 7.0), rounding);
  EXPECT_NEAR(panel.largest_relative_deviation.value(), 4.0 / 5.0, rounding);
}

TEST(PanelStatistics, DoNotDependOnTheOrder) {
  const PanelResult up = judge_panel({80, 85, 90}, remarking());
  const PanelResult down = judge_panel({90, 85, 80}, remarking());
  EXPECT_EQ(up.range_gu, down.range_gu);
  EXPECT_EQ(up.largest_relative_deviation, down.largest_relative_deviation);
  EXPECT_EQ(up.verdict, down.verdict);
}

TEST(PanelStatistics, OfOneReadingHaveNoSpread) {
  const PanelResult panel = judge_panel({85.0}, {.count = {.at_least = 1}});
  EXPECT_EQ(panel.mean_gu, 85.0);
  EXPECT_EQ(panel.range_gu, 0.0);
  EXPECT_EQ(panel.standard_deviation_gu, 0.0);
  EXPECT_EQ(panel.largest_relative_deviation, 0.0);
  EXPECT_EQ(panel.verdict, accepted);
}

TEST(PanelStatistics, HaveNoShareOfAMeanThatIsNotPositive) {
  EXPECT_EQ(judge_panel({0, 0, 0}, three_readings()).largest_relative_deviation, std::nullopt);
  EXPECT_EQ(judge_panel({-0.1, 0, 0}, three_readings()).largest_relative_deviation, std::nullopt);
}

TEST(PanelStatistics, NeedReadings) {
  EXPECT_THROW((void)judge_panel({}, three_readings()), std::invalid_argument);
  EXPECT_EQ(message_of([] { (void)judge_panel({}, three_readings()); }),
            "judge_panel: no readings");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)judge_panel({85.0, nan, 85.0}, three_readings()), std::invalid_argument);
  EXPECT_THROW((void)judge_panel({85.0, std::numeric_limits<double>::infinity()}, rejecting()),
               std::invalid_argument);
}

// Verdicts.

TEST(JudgePanel, AsksForTheNumberOfReadings) {
  const PanelResult two = judge_panel({85.0, 85.1}, three_readings());
  EXPECT_EQ(two.verdict, more_readings);
  EXPECT_EQ(two.further, 1U);
  EXPECT_EQ(two.evidence.sources, surest.sources);
  const PanelResult three = judge_panel({85.0, 85.1, 85.2}, three_readings());
  EXPECT_EQ(three.verdict, accepted);
  EXPECT_EQ(three.further, 0U);
}

TEST(JudgePanel, DoesNotJudgeTooFewReadings) {
  EXPECT_EQ(judge_panel({50.0, 90.0}, rejecting()).verdict, more_readings);
}

TEST(JudgePanel, RejectsARangeThatReachesTheLimit) {
  EXPECT_EQ(judge_panel({85, 90, 95}, rejecting()).verdict, rejected);
  EXPECT_EQ(judge_panel({85, 90, 94.9}, rejecting()).verdict, accepted);
  EXPECT_EQ(judge_panel({85, 90, 95.1}, rejecting()).verdict, rejected);
  EXPECT_EQ(judge_panel({85, 90, 95}, rejecting()).evidence.sources, sure.sources);
}

TEST(JudgePanel, TakesDecimalFractionsForWhatTheySay) {
  ReadingRule by_range = rejecting();
  by_range.reject->share_at_least.reset();
  ASSERT_LT(16.4 - 6.4, 10.0);  // in doubles
  EXPECT_EQ(judge_panel({6.4, 11.4, 16.4}, by_range).verdict, rejected);
  ASSERT_GT(8.3 - 3.3, 5.0);
  EXPECT_EQ(judge_panel({3.3, 5.0, 8.3}, asking_for_more()).verdict, accepted);
}

TEST(JudgePanel, RejectsARangeThatReachesItsShareOfTheMean) {
  EXPECT_EQ(judge_panel({18, 20, 22}, rejecting()).verdict, rejected);  // 4 of 20
  EXPECT_EQ(judge_panel({18.1, 20, 21.9}, rejecting()).verdict, accepted);
}

TEST(JudgePanel, RejectsByOneOfTheLimitsAlone) {
  ReadingRule rule = rejecting();
  rule.reject->share_at_least.reset();
  EXPECT_EQ(judge_panel({10, 15, 19}, rule).verdict, accepted);
  EXPECT_EQ(judge_panel({10, 15, 20}, rule).verdict, rejected);
  rule = rejecting();
  rule.reject->range_at_least_gu.reset();
  EXPECT_EQ(judge_panel({900, 905, 910}, rule).verdict, accepted);
  EXPECT_EQ(judge_panel({800, 900, 1000}, rule).verdict, rejected);
}

TEST(JudgePanel, JudgesReadingsRoundZeroByTheirRangeOnly) {
  EXPECT_EQ(judge_panel({0, 0, 0}, rejecting()).verdict, accepted);
  EXPECT_EQ(judge_panel({-0.1, 0, 0.1}, rejecting()).verdict, accepted);
  EXPECT_EQ(judge_panel({-0.2, -0.1, 0}, rejecting()).verdict, accepted);
  EXPECT_EQ(judge_panel({-0.2, -0.1, 0}, remarking()).verdict, accepted);
  EXPECT_EQ(judge_panel({-5, 0, 5}, rejecting()).verdict, rejected);
  EXPECT_EQ(judge_panel({0.1, 0.2, 0.3}, rejecting()).verdict, rejected);  // as the rule has it
}

TEST(JudgePanel, RemarksOnAReadingThatDiffersFromTheMeanByMoreThanAShare) {
  EXPECT_EQ(judge_panel({95, 100, 105}, remarking()).verdict, accepted);  // 5 % is not more
  EXPECT_EQ(judge_panel({94.9, 100, 105.1}, remarking()).verdict, not_uniform);
  // On one side only: 100, 100, 110 differ from 103.33 by 3.3 and 6.5 %.
  EXPECT_EQ(judge_panel({100, 100, 110}, remarking()).verdict, not_uniform);
  EXPECT_EQ(judge_panel({100, 100, 90}, remarking()).verdict, not_uniform);
  EXPECT_EQ(judge_panel({94.9, 100, 105.1}, remarking()).evidence.sources, sure.sources);
}

TEST(JudgePanel, AsksForFurtherReadingsWhereTheRangeIsLarge) {
  EXPECT_EQ(judge_panel({80, 82, 85}, asking_for_more()).verdict, accepted);
  const PanelResult panel = judge_panel({80, 82, 85.1}, asking_for_more());
  EXPECT_EQ(panel.verdict, more_readings);
  EXPECT_EQ(panel.further, 3U);
  EXPECT_EQ(panel.evidence.level, "memory");
  EXPECT_EQ(judge_panel({80, 82, 85.1, 82, 82}, asking_for_more()).further, 1U);
}

TEST(JudgePanel, LetsFurtherReadingsStandOnceTheyAreTaken) {
  EXPECT_EQ(judge_panel({80, 82, 85.1, 82, 82, 82}, asking_for_more()).verdict, accepted);
}

TEST(JudgePanel, AsksForOneFurtherReadingWhereTheirNumberIsNotKnown) {
  ReadingRule rule = asking_for_more();
  rule.more->count.reset();
  EXPECT_EQ(judge_panel({80, 82, 85.1}, rule).further, 1U);
  EXPECT_EQ(judge_panel({80, 82, 85.1, 82}, rule).verdict, accepted);
}

TEST(JudgePanel, NamesTheGraverFindingFirst) {
  ReadingRule rule = asking_for_more();
  rule.not_uniform = remarking().not_uniform;
  EXPECT_EQ(judge_panel({80, 85, 90}, rule).verdict, not_uniform);
  EXPECT_EQ(judge_panel({81, 84, 87}, rule).verdict, more_readings);  // 3.6 % and 6 GU
  rule.reject = rejecting().reject;
  EXPECT_EQ(judge_panel({80, 85, 90}, rule).verdict, rejected);
  EXPECT_EQ(judge_panel({80.1, 85, 90}, rule).verdict, not_uniform);
}

TEST(JudgePanel, AcceptsOnTheWeakestOfTheRulesThatWereAsked) {
  EXPECT_EQ(judge_panel({85, 85, 85}, three_readings()).evidence.level, "C2");
  EXPECT_EQ(judge_panel({85, 85, 85}, rejecting()).evidence.level, "C1");
  EXPECT_EQ(judge_panel({85, 85, 85}, remarking()).evidence.level, "C1");
  EXPECT_EQ(judge_panel({85, 85, 85}, asking_for_more()).evidence.level, "memory");
  EXPECT_EQ(judge_panel({85, 85, 85, 85, 85, 85}, asking_for_more()).evidence.level, "C2");
}

}  // namespace
}  // namespace gonio

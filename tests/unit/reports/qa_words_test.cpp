#include "reports/qa_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/reports/example_qa.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ChannelWords, NameEachKind) {
  EXPECT_EQ(channel_words({"60", "60", BatchChannel::Kind::gloss, "GU"}), "gloss at 60");
  EXPECT_EQ(channel_words({"60/colour", "60", BatchChannel::Kind::colour_difference, ""}),
            "colour difference at 60");
  EXPECT_EQ(channel_words({"haze_20", "", BatchChannel::Kind::haze, "GU"}), "haze (haze_20)");
}

TEST(LimitsWords, AreThoseOfAnySides) {
  EXPECT_EQ(limits_words({57.0, 63.0}, 60.0, "GU"), "60 +- 3 GU");
  EXPECT_EQ(limits_words({57.0, 63.0}, {}, "GU"), "60 +- 3 GU");
  EXPECT_EQ(limits_words({57.0, 63.0}, 59.0, "GU"), "57 to 63 GU");
  EXPECT_EQ(limits_words({80.0, {}}, {}, "GU"), "at least 80 GU");
  EXPECT_EQ(limits_words({{}, 1.0}, {}, ""), "at most 1");
  EXPECT_EQ(limits_words({}, 60.0, "GU"), "none");
}

TEST(ControlWords, TellWhichRulesSpokeHowOftenAndWhereFirst) {
  const ControlChart chart = test::example_charts(60.0, 1.0).mean.value();
  EXPECT_EQ(control_words(chart, "panel"),
            "not in control: rule 1 once, at panel 17; rule 2 twice, first at panel 17; rule 3 "
            "once, at panel 63; rule 4 once, at panel 90");
  EXPECT_EQ(control_words(test::example_chart(60.0, 1.0, 3), "panel"), "in control");
}

TEST(ControlWords, SayThatNoRuleIsAskedWithoutSpread) {
  EXPECT_EQ(control_words(ControlChart{}, "panel"), "no rule asked: the baseline knows no spread");
}

GaugeStudy study_of(double percent) {
  GaugeStudy study;
  study.percent_of_study = percent;
  return study;
}

TEST(GaugeWords, JudgeByTheUsualBounds) {
  EXPECT_THAT(gauge_words(study_of(9.9)), HasSubstr("fit: below 10 %"));
  EXPECT_THAT(gauge_words(study_of(10.0)), HasSubstr("for some uses"));
  EXPECT_THAT(gauge_words(study_of(30.1)), HasSubstr("not fit"));
  EXPECT_EQ(gauge_words(study_of(nan)), "not known");
}

TEST(GaugeComponents, AreSharesOfStudyAndTolerance) {
  const auto components = gauge_components(test::example_gauge().study);
  EXPECT_NEAR(components.front().percent_of_study, 28.177, 0.001);  // as the example states
  EXPECT_NEAR(components.front().percent_of_tolerance.value(), 30.6, 0.001);
  EXPECT_NEAR(components.back().percent_of_study, 100.0, 1e-9);
}

TEST(AnswerWords, TellHowManyReadings) {
  ReadingsAnswer answer = test::example_readings_answer();
  EXPECT_EQ(answer_words(answer),
            "4 readings of a panel keep both risks of a lot below 5 % (now 3).");
  answer.needed = 1;
  EXPECT_EQ(answer_words(answer),
            "1 reading of a panel keeps both risks of a lot below 5 % (now 3).");
  answer.needed.reset();
  EXPECT_EQ(answer_words(answer),
            "No number of readings of a panel that was tried, up to 6, keeps both risks of a lot "
            "below 5 % (now 3).");
}

TEST(AnswerWords, TellHowMuchSpreadInTheUnitOfTheParameter) {
  SpreadAnswer answer = test::example_spread_answer("roughness");
  EXPECT_EQ(answer_words(answer),
            "The roughness may vary by 3.1 % (standard deviation) until 5 % of the lots are "
            "refused (now 2.2 %).");
  answer.parameter = "refractive_index";
  EXPECT_THAT(answer_words(answer), HasSubstr("refractive index may vary by 0.031 ("));
  answer.allowed.reset();
  EXPECT_THAT(answer_words(answer), HasSubstr("Even without any spread of refractive index"));
  answer.unlimited = true;
  EXPECT_THAT(answer_words(answer), HasSubstr("that was tried, up to 0.064, has more than 5 %"));
}

TEST(QaMeaning, TellsWhyForEachVerdict) {
  using enum ConformanceVerdict;
  QaResult result = test::example_qa();
  EXPECT_EQ(qa_meaning(result), "Of 3 lots inspected 1 is refused: more than may be.");
  result.verdict = inconclusive;
  EXPECT_THAT(qa_meaning(result), HasSubstr("the uncertainty of the readings reaches over"));
  result.verdict = pass;
  EXPECT_THAT(qa_meaning(result), HasSubstr("1 is accepted"));
  result.verdict = not_applicable;
  EXPECT_THAT(qa_meaning(result), HasSubstr("no limit applies"));
}

}  // namespace
}  // namespace gonio

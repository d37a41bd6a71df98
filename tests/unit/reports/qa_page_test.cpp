#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <regex>
#include <string>
#include <system_error>

#include "emulator/core/text_file.hpp"
#include "reports/qa_report.hpp"
#include "reports/templates.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"
#include "tests/unit/reports/hostile_qa.hpp"

// How it looks and prints is seen by a browser in tests/pages.

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page_of(const QaResult& result) { return qa_page(result, "0.1.0"); }

TEST(QaPage, OpensWithTheVerdict) {
  const std::string page = page_of(test::example_qa());
  const auto title = page.find("<h1>Quality of batch coil_coating_60</h1>");
  const auto verdict = page.find("Verdict: <span aria-hidden=\"true\">");
  EXPECT_LT(title, verdict);
  EXPECT_LT(verdict, page.find("<table"));
}

TEST(QaPage, HasAChartOfEachKindForEachChannel) {
  const std::string page = page_of(test::example_qa());
  for (const char* caption :
       {"X-bar chart, gloss at 60", "R chart, gloss at 60", "I chart, haze (haze_20)",
        "MR chart, gloss at 60", "Means of panels, colour difference at 60",
        "Panel of 150 mm by 100 mm, gloss at 60", "Operating characteristic, gloss at 60",
        "Risks of a lot by the number of readings", "Lots refused by the spread of roughness"}) {
    EXPECT_THAT(page, HasSubstr(std::string("<figcaption>") + caption));
  }
  EXPECT_THAT(page, Not(HasSubstr("X-bar chart, haze")));
}

TEST(QaPage, AnswersBothQuestions) {
  const std::string page = page_of(test::example_qa());
  EXPECT_THAT(page, HasSubstr("<strong>4 readings of a panel keep both risks"));
  EXPECT_THAT(page, HasSubstr("<strong>The roughness may vary by 3.1 %"));
}

TEST(QaPage, HasAllThatItTakesToComputeTheRunAgain) {
  const std::string page = page_of(test::example_qa());
  for (const std::string& text :
       {std::string("20260101"), std::string(64, 'a'), std::string(64, 'd'),
        std::string("sqlite:qa.db"), std::string("fixtures/batches/coil_coating_60.yaml")}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(QaPage, NeedsNoScriptAndNoNetwork) {
  const std::string page = page_of(test::example_qa());
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
}

TEST(QaPage, HoldsHostileTextAsText) {
  const std::string page = page_of(test::hostile_qa(test::hostile_text("trace")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(page, HasSubstr("{{title}} {{{svg}}}"));
  EXPECT_THAT(page, Not(HasSubstr("\x1B")));
}

TEST(QaPage, LetsNobodyRunHostileText) {
  const test::TemporaryFolder folder;
  const auto trace = folder.path() / "trace";
  (void)page_of(test::hostile_qa(test::hostile_text(trace)));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(QaPage, TellsGnuplotNothingButNumbers) {
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  (void)page_of(test::hostile_qa("hostileword"));
  const std::string scripts = read_text_file(recorder.folder() / "scripts");
  for (const char* block : {"$signals", "$bins", "$spots", "$shares", "$simulated", "$risks"}) {
    EXPECT_THAT(scripts, HasSubstr(std::string(block) + " << END_OF_NUMBERS\n"));
  }
  EXPECT_THAT(scripts, Not(HasSubstr("hostileword")));
}

TEST(QaPage, IsThereOfNothing) {
  const std::string page = page_of(test::empty_qa());
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
}

TEST(QaPage, IsThereOfPartsWithoutNumbers) {
  EXPECT_THAT(page_of(test::bare_qa()), HasSubstr("</html>"));
}

void spoil_numbers(ChannelSummary& channel) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  channel.mean = channel.standard_deviation = channel.expanded_uncertainty = nan;
  channel.histogram.low = channel.histogram.width = nan;
  channel.charts.individual.centre = channel.charts.individual.sigma = nan;
  for (ChartPoint& point : channel.charts.individual.shown) {
    point.lowest = point.mean = point.highest = nan;
  }
  for (PositionSummary& position : channel.positions) {
    position.mean = nan;
  }
}

TEST(QaPage, DrawsWhatItCanOfNumbersThatAreNone) {
  QaResult result = test::example_qa();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (ChannelSummary& channel : result.channels) {
    spoil_numbers(channel);
  }
  result.gauge.front().study.sd_gauge = result.gauge.front().study.sd_total = nan;
  for (OcPoint& point : result.oc_curves.front().points) {
    point.mean = point.accepted.value = nan;
  }
  result.oc_curves.front().present_mean = nan;
  EXPECT_THAT(page_of(result), HasSubstr("</html>"));
}

TEST(QaPage, IsThereOfOnePanel) {
  QaResult result = test::example_qa();
  for (ChannelSummary& channel : result.channels) {
    channel.histogram = {.low = 60.0, .width = 0.0, .counts = {1}};
    channel.charts = {};
    channel.charts.individual.points = 1;
    channel.charts.individual.shown = {{1, 1, 60.0, 60.0, 60.0}};
  }
  EXPECT_THAT(page_of(result), HasSubstr("I chart, gloss at 60"));
}

TEST(QaPage, SaysThatPointsStandTogether) {
  QaResult result = test::example_qa();
  result.channels.front().charts.mean = test::example_chart(60.0, 0.8, 400, 250);
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  (void)page_of(result);
  const std::string scripts = read_text_file(recorder.folder() / "scripts");
  EXPECT_THAT(scripts, HasSubstr("thinned = 1"));
  EXPECT_THAT(scripts, HasSubstr("x_high = 100000.5"));
}

TEST(QaPage, IsAnErrorOfTheEnvironmentWithoutGnuplot) {
  const test::TemporaryFolder nothing;
  const test::SearchPath path(nothing.path().string());
  EXPECT_THROW((void)page_of(test::example_qa()), std::system_error);
}

}  // namespace
}  // namespace gonio

#include "reports/qa_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "emulator/core/text_file.hpp"
#include "reports/qa_trends.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"
#include "tests/unit/reports/hostile_qa.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Trends, AreByBatchAndChannelThenOfAllBatchesWithTheSameLimits) {
  const auto runs = test::example_history();
  const auto list = trends(runs);
  ASSERT_EQ(list.size(), 5u);
  EXPECT_EQ(trend_words(list[0]), "gloss at 60 of batch coil_coating_60");
  EXPECT_EQ(trend_words(list[3]), "colour difference at 60 of batch coil_coating_next");
  EXPECT_EQ(trend_words(list[4]), "gloss at 60 of all batches with the limits 60 +- 3 GU");
  EXPECT_EQ(list[0].points.size(), 12u);  // without the one that is not finished
  EXPECT_EQ(list[4].points.size(), 13u);
}

TEST(Trends, HaveTheControlChartOfTheMeansOfTwoRunsOrMore) {
  const auto runs = test::example_history();
  const auto list = trends(runs);
  ASSERT_TRUE(list[0].charts);
  EXPECT_EQ(list[0].charts->individual.points, 12u);
  EXPECT_FALSE(list[2].charts);
  EXPECT_EQ(list[0].charts->individual.first_signals.front().point, 9u);  // which was put there
}

TEST(Trends, LeaveOutMeansThatAreNone) {
  auto runs = test::example_history();
  runs.resize(3);
  runs[0].outcome->channels[0].mean = std::numeric_limits<double>::quiet_NaN();
  const auto list = trends(runs);
  ASSERT_TRUE(list[0].charts);
  EXPECT_EQ(list[0].charts->individual.points, 2u);
}

TEST(HistoryText, CountsRunsAndShowsTheOneThatIsNotFinished) {
  const std::string text = history_text(test::example_history(), "sqlite:qa.db", false);
  EXPECT_THAT(text, StartsWith("14 runs of 2 batches: 11 pass, 1 fail, 1 inconclusive, 1 not "
                               "finished\nin sqlite:qa.db\n"));
  EXPECT_THAT(text, HasSubstr("simulated  not finished  of 120 "));
}

TEST(HistoryText, IsThereWithoutRuns) {
  EXPECT_EQ(history_text({}, "sqlite:qa.db", false), "0 runs of 0 batches\nin sqlite:qa.db\n");
}

TEST(HistoryJson, HasRunsAndTrends) {
  const json written = json::parse(history_json(test::example_history(), "sqlite:qa.db"));
  EXPECT_EQ(written.at("schema"), "gonio/qa_history/1");
  EXPECT_EQ(written.at("store"), "sqlite:qa.db");
  ASSERT_EQ(written.at("runs").size(), 14u);
  const json& first = written.at("runs").at(0);
  EXPECT_EQ(first.at("outcome").at("verdict"), "pass");
  EXPECT_EQ(first.at("outcome").at("channels").at(0).at("channel"), "60");
  EXPECT_EQ(first.at("outcome").at("channels").at(0).at("cpk"), 1.13);
  EXPECT_TRUE(first.at("outcome").at("channels").at(1).at("cpk").is_null());
  EXPECT_EQ(written.at("runs").at(13).at("is_finished"), false);
  EXPECT_TRUE(written.at("runs").at(13).at("outcome").is_null());
  const json& trend = written.at("trends").at(0);
  EXPECT_EQ(trend.at("points").size(), 12u);
  EXPECT_EQ(trend.at("individual").at("points"), 12);
  EXPECT_TRUE(written.at("trends").at(2).at("individual").is_null());
  EXPECT_TRUE(written.at("trends").at(4).at("batch").is_null());
}

TEST(HistoryJson, HasNullForWhatIsNoNumber) {
  auto runs = test::example_history();
  runs[0].outcome->channels[0].mean = std::numeric_limits<double>::quiet_NaN();
  const json written = json::parse(history_json(runs, ""));  // which refuses NaN
  EXPECT_TRUE(written.at("runs").at(0).at("outcome").at("channels").at(0).at("mean").is_null());
}

TEST(HistoryCsv, HasARowForEachRunAndChannelOfAsManyCells) {
  const std::string csv = history_csv(test::example_history());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 13 * 2 + 1);
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    const auto quoted = std::count(line.begin(), line.end(), '"') > 0 ? 1 : 0;  // of the title
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 24 + quoted) << line;
  }
  EXPECT_THAT(csv, HasSubstr("14,coil_coating_60,\"Coil coating, semi-gloss\",simulated,"
                             "iso_2813/2014,2026-01-24T08:00:00Z,,not_finished,"));
}

TEST(HistoryCsv, HoldsHostileTextInItsCells) {
  const std::string csv = history_csv(test::hostile_history("a, \"b\"\n=cmd()\r\x1B"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 13 * 2 + 1);
  EXPECT_THAT(csv, Not(HasSubstr("\x1B")));
}

TEST(HistoryPage, OpensWithTheLatestVerdict) {
  const std::string page = history_page(test::example_history(), "sqlite:qa.db", "0.1.0");
  EXPECT_LT(page.find("Latest: <span aria-hidden=\"true\">"), page.find("<table"));
  EXPECT_THAT(page, HasSubstr("<p>Run 13 of batch coil_coating_next, started 2026-01-23 08:00"));
  EXPECT_THAT(page, HasSubstr("<figcaption>I chart of the means of runs, gloss at 60 of batch"));
}

TEST(HistoryPage, HoldsHostileTextAsText) {
  const test::TemporaryFolder folder;
  const auto trace = folder.path() / "trace";
  const std::string text = test::hostile_text(trace);
  const std::string page = history_page(test::hostile_history(text), text, text);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(HistoryPage, TellsGnuplotNothingButNumbers) {
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  (void)history_page(test::hostile_history("hostileword"), "hostileword", "hostileword");
  const std::string scripts = read_text_file(recorder.folder() / "scripts");
  EXPECT_THAT(scripts, HasSubstr("$points << END_OF_NUMBERS\n"));
  EXPECT_THAT(scripts, Not(HasSubstr("hostileword")));
}

TEST(HistoryPage, IsThereWithoutRunsAndOfRunsThatAreNotFinished) {
  EXPECT_THAT(history_page({}, "sqlite:qa.db", ""), HasSubstr("0 runs of 0 batches"));
  auto runs = test::example_history();
  runs.erase(runs.begin(), runs.end() - 1);
  const std::string page = history_page(runs, "sqlite:qa.db", "");
  EXPECT_THAT(page, HasSubstr("1 run of 1 batch: 1 not finished"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
}

}  // namespace
}  // namespace gonio

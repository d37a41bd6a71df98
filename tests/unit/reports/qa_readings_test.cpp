#include "reports/qa_readings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/reports/hostile_qa.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string csv_of(const RunRecord& run, const std::vector<PanelRecord>& panels) {
  std::ostringstream out;
  QaReadingsCsv writer(out, run);
  for (const PanelRecord& panel : panels) {
    writer.add(panel);
  }
  return out.str();
}

std::string json_of(const RunRecord& run, const std::vector<PanelRecord>& panels) {
  std::ostringstream out;
  QaReadingsJson writer(out, run);
  for (const PanelRecord& panel : panels) {
    writer.add(panel);
  }
  writer.finish();
  return out.str();
}

TEST(QaReadingsCsv, HasARowForEachReadingWithAllThatItTakesToComputeItAgain) {
  const std::string a(64, 'a');
  const std::string d(64, 'd');
  const std::string end = ",GU,20260101," + d + "," + a + ",0.1.0\n";
  EXPECT_EQ(csv_of(test::example_run(), {test::example_panel(41, "P-41")}),
            "run,study,lot,panel,label,channel,position,repetition,instrument,operator,value,unit,"
            "seed,instrument_sha256,sample_sha256,gonio_version\n"
            "7,inspection,2,41,P-41,60,1,1,triangle_gloss_2,second,61.1" +
                end + "7,inspection,2,41,P-41,60,2,1,triangle_gloss_2,second,62.1" + end);
}

TEST(QaReadingsCsv, HasNumbersAtFullPrecision) {
  PanelRecord panel = test::example_panel(1, "");
  panel.readings.front().value = 60.400000000000006;
  EXPECT_THAT(csv_of(test::example_run(), {panel}), HasSubstr(",60.400000000000006,GU,"));
}

TEST(QaReadingsCsv, IsEmptyWhereThereIsNothing) {
  PanelRecord panel = test::example_panel(1, "");
  panel.readings = {{.channel = 9,
                     .instrument = 9,
                     .operator_ = 9,
                     .value = std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_THAT(csv_of(test::example_run(), {panel}), HasSubstr("7,inspection,2,1,,,1,1,,,,,"));
}

TEST(QaReadingsCsv, HoldsHostileTextInItsCells) {
  RunRecord run = test::example_run();
  const std::string text = "a, \"b\"\n=cmd()\r\x1B";
  test::spoil(run, text);
  const std::string csv = csv_of(run, {test::example_panel(1, text)});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);  // the head and two readings
  EXPECT_THAT(csv, HasSubstr(",\"a, \"\"b\"\" =cmd()\","));
  EXPECT_THAT(csv, Not(HasSubstr("\x1B")));
}

TEST(QaReadingsJson, HasTheRunAndItsPanels) {
  const json written = json::parse(
      json_of(test::example_run(), {test::example_panel(1, "P-1"), test::example_panel(2, "")}));
  EXPECT_EQ(written.at("schema"), "gonio/qa_readings/1");
  EXPECT_EQ(written.at("run").at("seed"), 20260101);
  EXPECT_EQ(written.at("run").at("instruments").at(1).at("sha256"), std::string(64, 'd'));
  ASSERT_EQ(written.at("panels").size(), 2u);
  const json& panel = written.at("panels").at(0);
  EXPECT_EQ(panel.at("label"), "P-1");
  EXPECT_EQ(panel.at("study"), "inspection");
  EXPECT_EQ(panel.at("verdict"), "pass");
  EXPECT_EQ(panel.at("channels").at(0).at("truth"), 61.25);
  EXPECT_EQ(panel.at("readings").at(1).at("channel"), "60");
  EXPECT_EQ(panel.at("readings").at(1).at("operator"), "second");
  EXPECT_EQ(panel.at("readings").at(1).at("value"), 62.1);
}

TEST(QaReadingsJson, IsWholeWithoutPanels) {
  EXPECT_TRUE(json::parse(json_of(test::example_run(), {})).at("panels").empty());
}

TEST(QaReadingsJson, HasNullForWhatIsNoNumber) {
  PanelRecord panel = test::example_panel(1, "");
  panel.readings.front().value = std::numeric_limits<double>::infinity();
  panel.readings.front().channel = 9;
  panel.channels.front().truth.reset();
  const json written = json::parse(json_of(test::example_run(), {panel})).at("panels").at(0);
  EXPECT_TRUE(written.at("readings").at(0).at("value").is_null());
  EXPECT_TRUE(written.at("readings").at(0).at("channel").is_null());
  EXPECT_TRUE(written.at("channels").at(0).at("truth").is_null());
}

TEST(QaReadingsJson, HoldsHostileTextAsText) {
  RunRecord run = test::example_run();
  const std::string text = test::hostile_text("trace");
  test::spoil(run, text);
  const json written = json::parse(json_of(run, {test::example_panel(1, text)}));
  EXPECT_NE(written.at("panels").at(0).at("label").get<std::string>().find("{{title}}"),
            std::string::npos);
}

}  // namespace
}  // namespace gonio

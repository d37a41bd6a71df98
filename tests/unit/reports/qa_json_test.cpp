#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/qa_report.hpp"
#include "tests/unit/reports/hostile_qa.hpp"

namespace gonio {
namespace {

using nlohmann::json;

json json_of(const QaResult& result) { return json::parse(qa_json(result)); }

TEST(QaJson, HasTheKeysThatItsSchemaPromises) {
  const json written = json_of(test::example_qa());
  EXPECT_EQ(written.at("schema"), "gonio/qa/1");
  EXPECT_EQ(written.at("verdict"), "fail");
  EXPECT_EQ(written.at("panels"), 120);
  EXPECT_EQ(written.at("readings"), 720);
  EXPECT_EQ(written.at("mean_gu"), 60.4);
  EXPECT_EQ(written.at("sd_gu"), 0.83);
  EXPECT_EQ(written.at("cpk"), 1.083);
  EXPECT_EQ(written.at("producer_risk"), 0.021);
  EXPECT_EQ(written.at("consumer_risk"), 0.009);
  EXPECT_EQ(written.at("store"), "sqlite:qa.db");
  EXPECT_EQ(written.at("run"), 7);
}

TEST(QaJson, SpeaksOfTheMainChannelFirst) {
  QaResult result = test::example_qa();
  result.main_channel = 1;
  const json written = json_of(result);
  EXPECT_EQ(written.at("main_channel"), "60/colour");
  EXPECT_EQ(written.at("mean_gu"), 0.4);
  EXPECT_EQ(written.at("cpk"), 1.4);
}

TEST(QaJson, IsNullWhereThereIsNothing) {
  for (const QaResult& result : {test::empty_qa(), test::bare_qa()}) {
    const json written = json_of(result);
    for (const char* key : {"mean_gu", "sd_gu", "cpk"}) {
      EXPECT_TRUE(written.at(key).is_null()) << key;
    }
  }
  const json written = json_of(test::empty_qa());
  for (const char* key : {"producer_risk", "consumer_risk", "risks", "readings_answer"}) {
    EXPECT_TRUE(written.at(key).is_null()) << key;
  }
  EXPECT_TRUE(written.at("channels").empty());
}

TEST(QaJson, HasAllThatIsToldOfTheRun) {
  const json written = json_of(test::example_qa());
  const json& channel = written.at("channels").at(0);
  EXPECT_EQ(channel.at("capability").at("cpk").at("low"), 0.93);
  EXPECT_EQ(channel.at("charts").at("x_bar").at("signals_by_rule"), json({1, 2, 1, 1}));
  EXPECT_EQ(channel.at("charts").at("individual").at("shown").size(), 120u);
  EXPECT_EQ(channel.at("histogram").at("counts").size(), 20u);
  EXPECT_EQ(channel.at("positions").at(4).at("x_mm"), 75.0);
  EXPECT_TRUE(written.at("channels").at(2).at("charts").at("x_bar").is_null());
  EXPECT_TRUE(written.at("channels").at(2).at("capability").is_null());
  EXPECT_EQ(written.at("gauge").at(0).at("distinct_categories"), 4);
  EXPECT_EQ(written.at("risks").at("panel").at("consumer").at("value"), 0.0004);
  EXPECT_EQ(written.at("oc_curves").at(0).at("points").size(), 21u);
  EXPECT_EQ(written.at("readings_answer").at("needed"), 4);
  EXPECT_EQ(written.at("spread_answers").at(0).at("allowed"), 0.031);
  EXPECT_EQ(written.at("lots").at(2).at("verdict"), "inconclusive");
  EXPECT_EQ(written.at("remarks").size(), 2u);
}

TEST(QaJson, HasAllThatItTakesToComputeTheRunAgain) {
  const json run = json_of(test::example_qa()).at("provenance");
  EXPECT_EQ(run.at("seed"), 20260101);
  EXPECT_EQ(run.at("gonio_version"), "0.1.0");
  EXPECT_EQ(run.at("sample").at("sha256"), std::string(64, 'a'));
  EXPECT_EQ(run.at("instruments").at(1).at("sha256"), std::string(64, 'd'));
  EXPECT_EQ(run.at("batch_text"), test::example_run().batch_text);
}

TEST(QaJson, HasNumbersAtFullPrecision) {
  QaResult result = test::example_qa();
  const double value = 60.400000000000006;
  result.channels.front().mean = value;
  EXPECT_EQ(json_of(result).at("mean_gu"), value);
}

TEST(QaJson, HasNullForWhatIsNoNumber) {
  QaResult result = test::example_qa();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChannelSummary& channel = result.channels.front();
  channel.mean = nan;
  channel.capability->cpk->value = std::numeric_limits<double>::infinity();
  result.risks->lot.producer.value = nan;
  result.oc_curves.front().points.front().mean = nan;
  const std::string text = qa_json(result);
  const json written = json::parse(text);  // which refuses NaN and Infinity
  for (const char* key : {"mean_gu", "cpk", "producer_risk"}) {
    EXPECT_TRUE(written.at(key).is_null()) << key;
  }
}

TEST(QaJson, HoldsHostileTextAsText) {
  const std::string text = test::hostile_text("trace");
  const json written = json_of(test::hostile_qa(text));
  EXPECT_NE(written.at("decision").get<std::string>().find("{{title}} {{{svg}}}"),
            std::string::npos);
}

}  // namespace
}  // namespace gonio

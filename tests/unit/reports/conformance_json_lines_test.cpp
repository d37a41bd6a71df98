#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/hostile_report.hpp"

namespace gonio {
namespace {

using nlohmann::json;

std::vector<json> objects_of(const ConformanceReport& report) {
  std::istringstream in(conformance_json_lines(report));
  std::vector<json> objects;
  for (std::string line; std::getline(in, line);) {
    objects.push_back(json::parse(line));
  }
  return objects;
}

TEST(ConformanceJsonLines, HasTheRunThenClausesThenCases) {
  const ConformanceReport report = test::example_report();
  const auto objects = objects_of(report);
  ASSERT_EQ(objects.size(), 1 + report.clauses.size() + report.cases.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(objects[i].at("schema"), "gonio/conformance/1");
    EXPECT_EQ(objects[i].at("record"), i == 0                       ? "run"
                                       : i <= report.clauses.size() ? "clause"
                                                                    : "case");
  }
  EXPECT_EQ(objects.front().at("verdict"), "fail");
  EXPECT_EQ(objects[1].at("id"), "geometry/incidence_60");
  EXPECT_EQ(objects[1].at("effects").at(0).at("ladder").size(), 12u);
  EXPECT_EQ(objects[1].at("effects").at(0).at("low_deg"), 59.9);
  EXPECT_EQ(objects[1].at("cases").at(0), "iso_2813/2014/geometry/incidence_60/as_stated");
}

TEST(ConformanceJsonLines, HasNumbersAtFullPrecision) {
  ConformanceReport report = test::example_report();
  const double value = 60.100000000000001;
  report.cases.front().observations.front().value = value;
  EXPECT_EQ(objects_of(report)[1 + report.clauses.size()].at("observations").at(0).at("value"),
            value);
}

TEST(ConformanceJsonLines, IsNullForWhatIsNoNumberOrNotThere) {
  ConformanceReport report = test::example_report();
  Observation& found = report.cases.front().observations.front();
  found.value = std::nan("");
  found.low = -std::numeric_limits<double>::infinity();
  found.high.reset();
  const json written = objects_of(report)[1 + report.clauses.size()].at("observations").at(0);
  EXPECT_TRUE(written.at("value").is_null());
  EXPECT_TRUE(written.at("low").is_null());
  EXPECT_TRUE(written.at("high").is_null());
}

TEST(ConformanceJsonLines, KeepsHostileTextAsText) {
  const auto objects = objects_of(test::hostile_report("a\"\\\n`b` \xFF"));
  EXPECT_EQ(objects.front().at("device"), "a\"\\\n`b` \uFFFD");
}

}  // namespace
}  // namespace gonio

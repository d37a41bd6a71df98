#include "emulator/quality/limit_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

LimitText read(const std::string& text, const std::string& unit = "GU") {
  return YamlNode::parse("limits: '" + text + "'", "batch.yaml").read_map([&](YamlMap& map) {
    return read_limit_text(map.required("limits"), unit);
  });
}

std::string error_of(const std::string& text, const std::string& unit = "GU") {
  return test::message_of([&] { (void)read(text, unit); });
}

TEST(LimitText, IsATargetWithATolerance) {
  for (const char* text : {"85 +- 3 GU", "85 \u00B1 3 GU", "85+-3GU", "  85  +-  3  GU "}) {
    const LimitText read_text = read(text);
    EXPECT_EQ(read_text.limits, (Interval{.low = 82.0, .high = 88.0})) << text;
    EXPECT_EQ(read_text.target, 85.0) << text;
  }
}

TEST(LimitText, IsARange) {
  const LimitText text = read("82 to 88.5 GU");
  EXPECT_EQ(text.limits, (Interval{.low = 82.0, .high = 88.5}));
  EXPECT_FALSE(text.target);
  EXPECT_EQ(read("-2 to 1e1 GU").limits, (Interval{.low = -2.0, .high = 10.0}));
}

TEST(LimitText, IsALimitOnOneSide) {
  EXPECT_EQ(read(">= 80 GU").limits, (Interval{.low = 80.0, .high = {}}));
  EXPECT_EQ(read("<=10 GU").limits, (Interval{.low = {}, .high = 10.0}));
  EXPECT_FALSE(read(">= 80 GU").target);
}

TEST(LimitText, HasNoUnitWhereTheQuantityHasNone) {
  EXPECT_EQ(read("<= 1.5", "").limits, (Interval{.low = {}, .high = 1.5}));
  EXPECT_EQ(error_of("<= 1.5 GU", ""),
            "batch.yaml:1:9: limits: expected limits such as '85 +- 3', '82 to 88', '>= 80' or "
            "'<= 10', found '<= 1.5 GU'");
}

TEST(LimitText, SaysWhatItMayBe) {
  for (const char* text :
       {"85", "85 GU", "85 +- 3", "about 85 GU", "85 +- GU", "+- 3 GU", "> 80 GU", ">= GU",
        ">= high GU", "82 - 88 GU", "82 to GU", "to 88 GU", "82 to 88 to 90 GU", "85 +- 3 +- 1 GU",
        ">= 82 <= 88 GU", "GU", "82,5 to 88 GU", ">= inf GU", "85 +- 3 GU GU"}) {
    EXPECT_EQ(error_of(text),
              "batch.yaml:1:9: limits: expected limits such as '85 +- 3 GU', '82 to 88 GU', "
              "'>= 80 GU' or '<= 10 GU', found '" +
                  std::string(text) + "'");
  }
}

TEST(LimitText, LeavesRoomBetweenLimits) {
  EXPECT_EQ(error_of("88 to 82 GU"),
            "batch.yaml:1:9: limits: expected a lower limit before 'to' that is less than the "
            "upper one after it, found '88 to 82 GU'");
  EXPECT_NE(error_of("85 to 85 GU"), "no error");
  EXPECT_EQ(error_of("85 +- 0 GU"),
            "batch.yaml:1:9: limits: expected a number > 0 after '+-', found '85 +- 0 GU'");
  EXPECT_NE(error_of("85 +- -3 GU"), "no error");
}

TEST(LimitText, IsNoListOrMap) {
  const auto error = test::message_of(
      [] { (void)read_limit_text(YamlNode::parse("[82, 88]", "batch.yaml"), "GU"); });
  EXPECT_EQ(error,
            "batch.yaml:1:1: expected limits such as '85 +- 3 GU', '82 to 88 GU', '>= 80 GU' or "
            "'<= 10 GU', found 'a list'");
}

}  // namespace
}  // namespace gonio

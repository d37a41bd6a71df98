#include "emulator/protocol/point_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using testing::ElementsAre;

const Point& point(const std::string& id) { return *RegisterMap::standard().find(id); }

std::vector<std::uint16_t> registers(const std::string& id, const std::string& text) {
  return parse_value(point(id), text);
}
std::string error_of(const std::string& id, const std::string& text) {
  return test::message_of([&] { (void)registers(id, text); });
}

TEST(NumberText, NamesSymbolsAndBits) {
  EXPECT_EQ(number_text(point("state"), 3), "measuring");
  EXPECT_EQ(number_text(point("state"), 77), "77");
  EXPECT_EQ(number_text(point("status"), 0b10001), "ready+result_valid");
  EXPECT_EQ(number_text(point("status"), 0), "none");
  EXPECT_EQ(number_text(point("run_stop"), 1), "true");
  EXPECT_EQ(number_text(point("run_stop"), 0), "false");
}

TEST(NumberText, SaysWhatIsMissingOrOverRange) {
  EXPECT_EQ(number_text(point("gloss_1"), 92.3), "92.3");
  EXPECT_EQ(number_text(point("gloss_1"), std::nan("")), "-");
  EXPECT_EQ(number_text(point("gloss_1"), std::numeric_limits<double>::infinity()), "over range");
}

TEST(FindSymbol, FindsByTheNumber) {
  EXPECT_EQ(find_symbol(point("command_error"), 4)->name, "not_on_tile");
  EXPECT_EQ(find_symbol(point("command_error"), 99), nullptr);
}

TEST(ParseValue, TakesANameOrItsNumber) {
  EXPECT_THAT(registers("mode", "statistics"), ElementsAre(1));
  EXPECT_THAT(registers("mode", "4"), ElementsAre(4));
  EXPECT_EQ(error_of("mode", "fast"),
            "mode: expected one of single, statistics, continuous, difference, pass_fail, found "
            "'fast'");
  EXPECT_THAT(error_of("mode", "5"), testing::EndsWith(", found '5'"));
}

TEST(ParseValue, TakesNamesOfBits) {
  EXPECT_THAT(registers("measured_channels", "channel_1+channel_3"), ElementsAre(0b101));
  EXPECT_THAT(registers("measured_channels", "channel_2+channel_2"), ElementsAre(0b10));
  EXPECT_THAT(registers("measured_channels", "none"), ElementsAre(0));
  for (const std::string text : {"channel_4", "channel_1+", "", "channel_1+none", "5"}) {
    EXPECT_EQ(error_of("measured_channels", text),
              "measured_channels: expected none, or some of channel_1, channel_2, channel_3 with + "
              "between them, found '" +
                  text + "'");
  }
}

TEST(ParseValue, TakesNumbers) {
  EXPECT_THAT(registers("lower_limit_1", "80"), ElementsAre(0x42A0, 0));
  EXPECT_THAT(registers("lower_limit_1", "-1e-1"), ElementsAre(0xBDCC, 0xCCCD));
  EXPECT_THAT(registers("statistics_readings", "65535"), ElementsAre(0xFFFF));
  EXPECT_THAT(registers("wire_fault_probability", "4294967295"), ElementsAre(0xFFFF, 0xFFFF));
  EXPECT_THAT(registers("gloss_tenths_1", "92.3"), ElementsAre(923));
}

TEST(ParseValue, RefusesNumbersThatDoNotFit) {
  for (const std::string text : {"", "x", "80 GU", "nan", "inf", "1e39"}) {
    EXPECT_EQ(error_of("lower_limit_1", text),
              "lower_limit_1: expected a number, found '" + text + "'");
  }
  for (const std::string text : {"-1", "65536", "1.5", "0x10"}) {
    EXPECT_EQ(error_of("statistics_readings", text),
              "statistics_readings: expected a whole number in [0, 65535], found '" + text + "'");
  }
  EXPECT_EQ(error_of("wire_fault_probability", "4294967296"),
            "wire_fault_probability: expected a whole number in [0, 4294967295], found "
            "'4294967296'");
  EXPECT_EQ(error_of("gloss_tenths_1", "92.35"),
            "gloss_tenths_1: expected a multiple of 0.1 in [-3276.8, 3276.7], found '92.35'");
}

TEST(ParseValue, TakesTrueAndFalseForABit) {
  EXPECT_THAT(registers("run_measure", "true"), ElementsAre(1));
  EXPECT_THAT(registers("run_measure", "false"), ElementsAre(0));
  EXPECT_EQ(error_of("run_measure", "1"), "run_measure: expected true or false, found '1'");
}

TEST(ParseValue, TakesTextThatFits) {
  EXPECT_THAT(registers("sunspec_marker", "Sun"), ElementsAre(0x5375, 0x6E00));
  EXPECT_EQ(error_of("sunspec_marker", "SunSp"),
            "sunspec_marker: expected up to 4 characters, found 'SunSp'");
}

}  // namespace
}  // namespace gonio

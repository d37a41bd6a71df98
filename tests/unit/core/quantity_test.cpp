#include "emulator/core/quantity.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <locale>
#include <numbers>
#include <string>
#include <string_view>

namespace gonio {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect_value(std::string_view text, Dimension dimension, double expected) {
  const auto value = parse_quantity(text, dimension);
  ASSERT_TRUE(value.has_value()) << "'" << text << "' was refused";
  EXPECT_DOUBLE_EQ(*value, expected) << "'" << text << "'";
}

TEST(ParseQuantity, ReadsEachUnitInTheBaseUnitOfItsDimension) {
  expect_value("1.567", Dimension::number, 1.567);
  expect_value("180 deg", Dimension::angle, std::numbers::pi);
  expect_value("0.5 rad", Dimension::angle, 0.5);
  expect_value("2 mrad", Dimension::angle, 0.002);
  expect_value("550 nm", Dimension::length, 550.0);
  expect_value("2 um", Dimension::length, 2000.0);
  expect_value("3 mm", Dimension::length, 3e6);
  expect_value("0.1 GU", Dimension::gloss, 0.1);
  expect_value("4 s", Dimension::time, 4.0);
  expect_value("10 ms", Dimension::time, 0.01);
  expect_value("5 min", Dimension::time, 300.0);
  expect_value("2 h", Dimension::time, 7200.0);
  expect_value("-3.5 degC", Dimension::temperature, -3.5);
  expect_value("6 K", Dimension::temperature_difference, 6.0);
}

TEST(ParseQuantity, ReadsSignsExponentsAndAnyNumberOfBlanks) {
  expect_value("-0.1", Dimension::number, -0.1);
  expect_value("+0.1 deg", Dimension::angle, 0.1 * std::numbers::pi / 180.0);
  expect_value("7.0E-06", Dimension::number, 7e-6);
  expect_value(".5", Dimension::number, 0.5);
  expect_value("60deg", Dimension::angle, std::numbers::pi / 3.0);
  expect_value("60    deg", Dimension::angle, std::numbers::pi / 3.0);
}

TEST(ParseQuantity, RefusesWhatIsNotAFiniteNumber) {
  for (const char* text : {"", " ", "nan", "NaN", "-nan", "inf", "-inf", "infinity", "1e999", "abc",
                           "--1", "++1", "+-1", "-+1", ".", "-", "~", "true"}) {
    EXPECT_FALSE(parse_quantity(text, Dimension::number)) << "'" << text << "'";
  }
  EXPECT_FALSE(parse_quantity("nan deg", Dimension::angle));
  EXPECT_FALSE(parse_quantity("inf nm", Dimension::length));
}

TEST(ParseQuantity, RefusesTextAfterTheNumberAndItsUnit) {
  for (const char* text : {"1 x", "1e", "0x10", "1.5.2", "1 2", "0,5", "1_000", "1'000"}) {
    EXPECT_FALSE(parse_quantity(text, Dimension::number)) << "'" << text << "'";
  }
  for (const char* text : {"60 deg.", "60 degrees", "60 deg 2", "60 deg deg"}) {
    EXPECT_FALSE(parse_quantity(text, Dimension::angle)) << "'" << text << "'";
  }
}

TEST(ParseQuantity, RefusesAMissingAForeignAndAMisspeltUnit) {
  EXPECT_FALSE(parse_quantity("60", Dimension::angle));
  EXPECT_FALSE(parse_quantity("60 nm", Dimension::angle));
  EXPECT_FALSE(parse_quantity("60 deg", Dimension::number));
  EXPECT_FALSE(parse_quantity("60 Deg", Dimension::angle));
  EXPECT_FALSE(parse_quantity("0.1 gu", Dimension::gloss));
  EXPECT_FALSE(parse_quantity("1 m", Dimension::length));
  EXPECT_FALSE(parse_quantity("23 K", Dimension::temperature));
  EXPECT_FALSE(parse_quantity("6 degC", Dimension::temperature_difference));
}

/// Writes numbers as much of Europe does: 1.000,5.
struct CommaForDecimals : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ParseQuantity, DoesNotRegardTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaForDecimals));
  const auto value = parse_quantity("1234.5 nm", Dimension::length);
  const auto with_comma = parse_quantity("1234,5 nm", Dimension::length);
  const std::string range = Range::closed(0.5, 1234.5).text();
  std::locale::global(before);
  EXPECT_EQ(value, 1234.5);
  EXPECT_EQ(with_comma, std::nullopt);
  EXPECT_EQ(range, " in [0.5, 1234.5]");
}

TEST(ExpectedQuantity, NamesTheUnits) {
  EXPECT_EQ(expected_quantity(Dimension::number), "a number");
  EXPECT_EQ(expected_quantity(Dimension::angle), "an angle (deg, rad, mrad)");
  EXPECT_EQ(expected_quantity(Dimension::length), "a length (nm, um, mm)");
  EXPECT_EQ(expected_quantity(Dimension::gloss), "a gloss value (GU)");
  EXPECT_EQ(expected_quantity(Dimension::time), "a time (s, ms, min, h)");
}

TEST(Range, ContainsItsEndsUnlessTheyAreOpen) {
  EXPECT_TRUE(Range::closed(0, 1).contains(0.0));
  EXPECT_TRUE(Range::closed(0, 1).contains(1.0));
  EXPECT_FALSE(Range::closed(0, 1).contains(1.0000001));
  EXPECT_FALSE(Range::positive().contains(0.0));
  EXPECT_TRUE(Range::positive().contains(1e-300));
  EXPECT_TRUE(Range::not_negative().contains(0.0));
  EXPECT_FALSE((Range{.low = 0.0, .high = 1.0, .high_open = true}.contains(1.0)));
}

TEST(Range, NeverContainsNaN) {
  for (const Range& range : {Range::any(), Range::positive(), Range::closed(-1, 1)}) {
    EXPECT_FALSE(range.contains(not_a_number)) << range.text();
  }
  EXPECT_TRUE(Range::any().contains(-infinity));
}

TEST(Range, SaysWhatItContains) {
  EXPECT_EQ(Range::any().text(), "");
  EXPECT_EQ(Range::positive().text(), " > 0");
  EXPECT_EQ(Range::not_negative().text(), " >= 0");
  EXPECT_EQ(Range::closed(0, 1).text(), " in [0, 1]");
  EXPECT_EQ((Range{.low = 0.0, .high = 90.0, .low_open = true, .high_open = true}.text()),
            " in (0, 90)");
  EXPECT_EQ((Range{.high = 2.5}.text()), " <= 2.5");
  EXPECT_EQ((Range{.high = 2.5, .high_open = true}.text()), " < 2.5");
}

}  // namespace
}  // namespace gonio

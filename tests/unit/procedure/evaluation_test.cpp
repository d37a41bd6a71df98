#include "emulator/procedure/evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using test::shipped_standard;

// Haze of ASTM D4039: G60 - G20, for specimens above 70 GU at 60 deg.

HazeRule haze_index() { return shipped_standard("astm_d4039/09").haze.front(); }

TEST(Haze, IsTheDifferenceOfTwoValues) {
  const HazeResult result = haze(haze_index(), {{"60", 80.0}, {"20", 50.0}});
  EXPECT_EQ(result.id, "haze_index");
  EXPECT_EQ(result.value, 30.0);
  EXPECT_EQ(haze(haze_index(), {{"60", 95.0}, {"20", 95.0}}).value, 0.0);
  EXPECT_EQ(haze(haze_index(), {{"60", 90.0}, {"20", 95.0}}).value, -5.0);
}

TEST(Haze, IsNotDefinedAtItsLimit) {
  EXPECT_EQ(haze(haze_index(), {{"60", 70.0}, {"20", 50.0}}).value, std::nullopt);
  EXPECT_EQ(haze(haze_index(), {{"60", std::nextafter(70.0, 0.0)}, {"20", 50.0}}).value,
            std::nullopt);
  EXPECT_EQ(haze(haze_index(), {{"60", 70.5}, {"20", 50.0}}).value, 20.5);
  EXPECT_NE(haze(haze_index(), {{"60", std::nextafter(70.0, 100.0)}, {"20", 50.0}}).value,
            std::nullopt);
}

TEST(Haze, NeedsBothValues) {
  EXPECT_EQ(haze(haze_index(), {{"60", 80.0}}).value, std::nullopt);
  EXPECT_EQ(haze(haze_index(), {{"20", 80.0}}).value, std::nullopt);
  EXPECT_EQ(haze(haze_index(), {{"60", 80.0}, {"85", 50.0}}).value, std::nullopt);
}

TEST(Haze, HasNoLimitWhereTheRuleHasNone) {
  HazeRule rule = haze_index();
  rule.only_above.reset();
  EXPECT_EQ(haze(rule, {{"60", 10.0}, {"20", 4.0}}).value, 6.0);
}

// Rounding.

TEST(ReportedValue, OfIso2813IsTheNearestUnit) {
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_EQ(reported_value(84.4, standard), 84.0);
  EXPECT_EQ(reported_value(84.6, standard), 85.0);
  EXPECT_EQ(reported_value(84.49999, standard), 84.0);
  EXPECT_EQ(reported_value(2000.2, standard), 2000.0);
}

TEST(ReportedValue, OfAHalfIsTheOneAwayFromZero) {
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_EQ(reported_value(84.5, standard), 85.0);
  EXPECT_EQ(reported_value(85.5, standard), 86.0);
  EXPECT_EQ(reported_value(0.5, standard), 1.0);
  EXPECT_EQ(reported_value(-0.5, standard), -1.0);
}

TEST(ReportedValue, NearZeroIsZeroWithoutASign) {
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_EQ(reported_value(0.3, standard), 0.0);
  EXPECT_FALSE(std::signbit(reported_value(-0.3, standard)));
  EXPECT_FALSE(std::signbit(reported_value(-0.0, standard)));
}

TEST(ReportedValue, TakesDecimalFractionsForWhatTheySay) {
  Standard standard = shipped_standard("iso_2813/2014");
  standard.rounding->nominal = 0.1;
  constexpr double last_bits = 1e-12;
  ASSERT_LT(1.15 / 0.1, 11.5);  // in doubles
  EXPECT_NEAR(reported_value(1.15, standard), 1.2, last_bits);
  EXPECT_NEAR(reported_value(1.149, standard), 1.1, last_bits);
  EXPECT_NEAR(reported_value(-84.25, standard), -84.3, last_bits);
}

TEST(ReportedValue, IsTheValueWhereTheStandardHasNoRule) {
  const Standard standard = shipped_standard("astm_d523/14");
  ASSERT_FALSE(standard.rounding);
  EXPECT_EQ(reported_value(84.4567, standard), 84.4567);
}

}  // namespace
}  // namespace gonio

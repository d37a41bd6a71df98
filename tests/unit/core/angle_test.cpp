#include "emulator/core/angle.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gonio {
namespace {

TEST(Angle, ConvertsBetweenDegreesAndRadians) {
  EXPECT_DOUBLE_EQ(degrees(180).radians(), std::numbers::pi);
  EXPECT_DOUBLE_EQ(radians(std::numbers::pi / 3).degrees(), 60.0);
  for (const double value : {-85.0, 0.0, 20.0, 45.0, 60.0, 75.0, 85.0}) {
    EXPECT_DOUBLE_EQ(degrees(value).degrees(), value);
  }
}

TEST(Angle, IsZeroByDefault) { EXPECT_EQ(Angle(), degrees(0)); }

TEST(Angle, AddsSubtractsScalesAndNegates) {
  EXPECT_DOUBLE_EQ((degrees(60) + degrees(0.1)).degrees(), 60.1);
  EXPECT_DOUBLE_EQ((degrees(60) - degrees(0.1)).degrees(), 59.9);
  EXPECT_DOUBLE_EQ((0.5 * degrees(4.4)).degrees(), 2.2);
  EXPECT_DOUBLE_EQ((-degrees(20)).degrees(), -20.0);
}

TEST(Angle, IsOrdered) {
  EXPECT_LT(degrees(20), degrees(60));
  EXPECT_GT(radians(1), degrees(57));
  EXPECT_NE(radians(1), degrees(1));
}

}  // namespace
}  // namespace gonio

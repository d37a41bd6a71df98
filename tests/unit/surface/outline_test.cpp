#include "emulator/surface/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gonio {
namespace {

constexpr double rounding = 1e-12;
const Outline rectangle{.x_mm = 10, .y_mm = 20, .half_length_mm = 4, .half_width_mm = 3};
const Outline ellipse{.kind = Outline::Kind::ellipse,
                      .x_mm = 10,
                      .y_mm = 20,
                      .half_length_mm = 4,
                      .half_width_mm = 3};

TEST(Outline, HasTheAreaOfItsForm) {
  EXPECT_DOUBLE_EQ(rectangle.area_mm2(), 48.0);
  EXPECT_DOUBLE_EQ(ellipse.area_mm2(), 12.0 * std::numbers::pi);
}

TEST(Outline, OfARectangleHasChordsOfOneLength) {
  for (const double y : {17.001, 20.0, 22.999}) {
    ASSERT_TRUE(rectangle.chord(y)) << y;
    EXPECT_EQ(rectangle.chord(y)->low, 6.0);
    EXPECT_EQ(rectangle.chord(y)->high, 14.0);
  }
}

TEST(Outline, OfAnEllipseHasChordsThatEndOnIt) {
  for (const double y : {17.1, 19.0, 20.0, 22.9}) {
    const auto chord = ellipse.chord(y);
    ASSERT_TRUE(chord) << y;
    for (const double x : {chord->low, chord->high}) {
      EXPECT_NEAR(std::pow((x - 10.0) / 4.0, 2) + std::pow((y - 20.0) / 3.0, 2), 1.0, rounding);
    }
  }
}

TEST(Outline, HasNoChordBesideIt) {
  for (const double y : {16.9, 17.0, 23.0, 30.0, std::nan("")}) {
    EXPECT_FALSE(rectangle.chord(y)) << y;
    EXPECT_FALSE(ellipse.chord(y)) << y;
  }
}

TEST(CommonChord, IsWhatBothCover) {
  EXPECT_EQ(common({0, 2}, {1, 3})->low, 1.0);
  EXPECT_EQ(common({0, 2}, {1, 3})->high, 2.0);
  EXPECT_FALSE(common({0, 1}, {1, 2}));
  EXPECT_FALSE(common({0, 1}, {2, 3}));
}

}  // namespace
}  // namespace gonio

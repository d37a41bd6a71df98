#include "emulator/surface/spot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace gonio {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Spot wide{.x_mm = 75, .y_mm = 50, .half_length_mm = 19, .half_width_mm = 2.5};
const Spot round_spot{.x_mm = 80, .y_mm = 52, .half_length_mm = 5, .half_width_mm = 5};

Spot moved(Spot spot, double x_mm, double y_mm) {
  spot.x_mm += x_mm;
  spot.y_mm += y_mm;
  return spot;
}

TEST(SpotCorrelation, OfPointsIsTheCorrelationAtTheirDistance) {
  constexpr double tolerance = 1e-7;  // points are widened by 1e-4 of the correlation length
  const Spot origin{.x_mm = 3, .y_mm = 4};
  for (const double L : {0.1, 2.0, 10.0, 1000.0}) {
    EXPECT_NEAR(spot_correlation(origin, origin, L), 1.0, tolerance);
    const Spot away{.x_mm = 3 + 0.6 * L, .y_mm = 4 - 0.8 * L};
    EXPECT_NEAR(spot_correlation(origin, away, L), std::exp(-0.5), tolerance) << L;
  }
}

TEST(SpotCorrelation, OfLongFieldsFallsWithTheMeanSquareDistance) {
  // exp(-x) = 1 - x + x^2 / 2 - ...; the mean of d^2 over both ellipses in closed form.
  constexpr double L = 1000.0;
  constexpr double second_order = 1e-7;
  const auto square_radius = [](const Spot& s) {
    return (s.half_length_mm * s.half_length_mm + s.half_width_mm * s.half_width_mm) / 4.0;
  };
  for (const Spot& b : {wide, round_spot}) {
    const double dx = b.x_mm - wide.x_mm, dy = b.y_mm - wide.y_mm;
    const double d2 = dx * dx + dy * dy + square_radius(wide) + square_radius(b);
    EXPECT_NEAR(spot_correlation(wide, b, L), 1.0 - d2 / (2.0 * L * L), second_order);
  }
}

TEST(SpotCorrelation, EqualsTheMeanOverRandomPairsOfPoints) {
  constexpr int pairs = 200'000;
  constexpr unsigned seed = 60;
  constexpr double tolerance = 5e-3;  // 4.5 standard deviations of a mean of numbers in [0, 1]
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point_of = [&](const Spot& spot) {
    for (;;) {
      const double u = uniform(random), v = uniform(random);
      if (u * u + v * v < 1.0) {
        return std::pair(spot.x_mm + u * spot.half_length_mm, spot.y_mm + v * spot.half_width_mm);
      }
    }
  };
  for (const double L : {2.0, 5.0, 20.0}) {
    double sum = 0.0;
    for (int i = 0; i < pairs; ++i) {
      const auto [x, y] = point_of(wide);
      const auto [u, v] = point_of(round_spot);
      sum += std::exp(-0.5 * ((x - u) * (x - u) + (y - v) * (y - v)) / (L * L));
    }
    EXPECT_NEAR(spot_correlation(wide, round_spot, L), sum / pairs, tolerance) << L;
  }
}

TEST(SpotCorrelation, OfShortFieldsIsThatOfWhatBothCover) {
  // 2 pi L^2 / area for a spot with itself; the edge is missing a share of the order L / size.
  constexpr double L = 0.05;
  const double expected = 2.0 * L * L / (5.0 * 5.0);
  EXPECT_NEAR(spot_correlation(round_spot, round_spot, L), expected, 0.02 * expected);
  EXPECT_EQ(spot_correlation(round_spot, moved(round_spot, 10.5, 0), L), 0.0);
}

TEST(SpotCorrelation, HasNoStepWhereItsRuleChanges) {
  // From lines to overlap at L = pi * 5 mm / 160: relative to L^2 both agree but for the edge.
  constexpr double edge = 0.03;
  const double L = M_PI * 5.0 / 160.0;
  const double below = spot_correlation(round_spot, round_spot, 0.999 * L);
  const double above = spot_correlation(round_spot, round_spot, 1.001 * L);
  EXPECT_NEAR(above / below, 1.0, edge);
  EXPECT_NEAR(above, below, 1e-4);
}

TEST(SpotCorrelation, IsZeroOrOneAtTheEndsOfTheScale) {
  EXPECT_EQ(spot_correlation(wide, round_spot, inf), 1.0);
  EXPECT_EQ(spot_correlation(wide, wide, 0.0), 0.0);
  const Spot point{.x_mm = 1, .y_mm = 1};
  EXPECT_EQ(spot_correlation(point, point, 0.0), 1.0);
  EXPECT_EQ(spot_correlation(point, moved(point, 1, 0), 0.0), 0.0);
}

TEST(SpotCorrelation, DoesNotDependOnTheOrder) {
  constexpr double rounding = 1e-6;
  for (const double L : {1.0, 10.0}) {
    EXPECT_NEAR(spot_correlation(wide, round_spot, L), spot_correlation(round_spot, wide, L),
                rounding);
  }
}

TEST(SpotCorrelation, NeedsALength) {
  EXPECT_THROW((void)spot_correlation(wide, wide, -1.0), std::domain_error);
  EXPECT_THROW((void)spot_correlation(wide, wide, NAN), std::domain_error);
}

}  // namespace
}  // namespace gonio

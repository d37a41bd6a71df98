#include "emulator/surface/panel_layout.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using std::numbers::pi;

constexpr double area_tolerance = 1e-3;  // as stated of shares()
const Spot spot{.x_mm = 75, .y_mm = 50, .half_length_mm = 10, .half_width_mm = 4};

Outline rectangle(double x, double y, double length, double width) {
  return {.kind = Outline::Kind::rectangle,
          .x_mm = x,
          .y_mm = y,
          .half_length_mm = 0.5 * length,
          .half_width_mm = 0.5 * width};
}
Outline ellipse(double x, double y, double length, double width) {
  Outline outline = rectangle(x, y, length, width);
  outline.kind = Outline::Kind::ellipse;
  return outline;
}

/// A panel of 150 mm x 100 mm with regions over its base.
PanelLayout panel_with(const std::vector<Outline>& outlines) {
  PanelLayout layout{.length_mm = 150, .width_mm = 100};
  layout.regions.push_back({.id = "base"});
  for (const Outline& outline : outlines) {
    layout.regions.push_back({.id = fmt::format("r{}", layout.regions.size()), .outline = outline});
  }
  return layout;
}

PanelLayout panel_with_map(const Eigen::ArrayXXd& roughness) {
  PanelLayout layout = panel_with({});
  layout.maps[0].emplace(roughness, layout.length_mm, layout.width_mm);
  return layout;
}

double share_of(const std::vector<SpotShare>& shares, std::size_t region) {
  return std::accumulate(shares.begin(), shares.end(), 0.0, [&](double sum, const SpotShare& s) {
    return sum + (s.region == region ? s.weight : 0.0);
  });
}

template <class Function>
double mean_of(const std::vector<SpotShare>& shares, Function&& f) {
  return std::accumulate(shares.begin(), shares.end(), 0.0, [&](double sum, const SpotShare& s) {
    return sum + s.weight * f(s.deviation.roughness);
  });
}

/// Share of the unit disc on one side of a chord at distance t from its middle, -1 <= t <= 1.
double segment(double t) { return (std::acos(t) - t * std::sqrt(1.0 - t * t)) / pi; }

TEST(SpotShares, OfAHalfPlaneAreTheSegmentOfAnEllipse) {
  for (double t = -0.95; t < 1.0; t += 0.05) {
    const PanelLayout beyond_x = panel_with({rectangle(75 + 10 * t + 50, 50, 100, 100)});
    EXPECT_NEAR(share_of(shares(beyond_x, spot), 1), segment(t), area_tolerance) << t;
    const PanelLayout beyond_y = panel_with({rectangle(75, 50 + 4 * t + 50, 150, 100)});
    EXPECT_NEAR(share_of(shares(beyond_y, spot), 1), segment(t), area_tolerance) << t;
  }
}

TEST(SpotShares, OfAStripeAreTheDifferenceOfTwoSegments) {
  const PanelLayout layout = panel_with({rectangle(77, 50, 6, 100)});  // from 74 to 80
  EXPECT_NEAR(share_of(shares(layout, spot), 1), segment(-0.1) - segment(0.5), area_tolerance);
  EXPECT_NEAR(share_of(shares(layout, spot), 0), 1.0 - segment(-0.1) + segment(0.5),
              area_tolerance);
}

TEST(SpotShares, OfAnEllipseWithinAreTheRatioOfAreas) {
  for (const double scale : {0.01, 0.3, 0.9, 1.0}) {
    const PanelLayout layout = panel_with({ellipse(75, 50, 20 * scale, 8 * scale)});
    EXPECT_NEAR(share_of(shares(layout, spot), 1), scale * scale, area_tolerance) << scale;
  }
  const PanelLayout upright = panel_with({ellipse(73, 50.5, 2, 5)});
  EXPECT_NEAR(share_of(shares(upright, spot), 1), 10.0 / 160.0, area_tolerance);
}

TEST(SpotShares, OfTwoEqualCirclesAreTheirLens) {
  const Spot circle{.x_mm = 75, .y_mm = 50, .half_length_mm = 5, .half_width_mm = 5};
  for (const double d : {1.0, 5.0, 9.0}) {
    EXPECT_NEAR(share_of(shares(panel_with({ellipse(75 + d, 50, 10, 10)}), circle), 1),
                2.0 * segment(d / 10.0), area_tolerance)
        << d;
  }
}

TEST(SpotShares, ShowTheLaterOfTwoRegionsThatOverlap) {
  const PanelLayout layout =
      panel_with({rectangle(75, 50, 150, 100), rectangle(110, 50, 70, 100)});  // from 75 on
  const auto parts = shares(layout, spot);
  EXPECT_EQ(share_of(parts, 0), 0.0);
  EXPECT_NEAR(share_of(parts, 1), 0.5, area_tolerance);
  EXPECT_NEAR(share_of(parts, 2), 0.5, area_tolerance);
}

TEST(SpotShares, OfAPointAreTheRegionThere) {
  const PanelLayout layout = panel_with({rectangle(75, 50, 20, 100)});
  const auto within = shares(layout, Spot{.x_mm = 84.99, .y_mm = 50});
  ASSERT_EQ(within.size(), 1u);
  EXPECT_EQ(within[0].region, 1u);
  EXPECT_EQ(shares(layout, Spot{.x_mm = 85.01, .y_mm = 50})[0].region, 0u);
}

TEST(SpotShares, SumToOneOverTheEdgeOfThePanelToo) {
  constexpr double rounding = 1e-12;
  const PanelLayout layout = panel_with({rectangle(0, 50, 8, 100)});
  const Spot over_the_edge{.x_mm = 0, .y_mm = 50, .half_length_mm = 8, .half_width_mm = 4};
  EXPECT_FALSE(layout.carries(over_the_edge));
  const auto parts = shares(layout, over_the_edge);
  EXPECT_NEAR(share_of(parts, 0) + share_of(parts, 1), 1.0, rounding);
  EXPECT_NEAR(share_of(parts, 0), 2.0 * segment(0.5), area_tolerance);
}

TEST(SpotShares, OffThePanelAreRefused) {
  const Spot beside{.x_mm = 170, .y_mm = 50, .half_length_mm = 8, .half_width_mm = 4};
  EXPECT_EQ(test::message_of([&] { (void)shares(panel_with({}), beside); }),
            "shares: the spot must lie on the panel of 150 mm x 100 mm, is at 170 mm, 50 mm");
  EXPECT_THROW((void)shares(panel_with({}), beside), std::domain_error);
}

TEST(PanelLayout, CarriesASpotUpToItsEdge) {
  const PanelLayout layout = panel_with({});
  EXPECT_TRUE(layout.carries({.x_mm = 10, .y_mm = 4, .half_length_mm = 10, .half_width_mm = 4}));
  EXPECT_FALSE(layout.carries({.x_mm = 9.9, .y_mm = 4, .half_length_mm = 10, .half_width_mm = 4}));
  EXPECT_FALSE(
      layout.carries({.x_mm = 10, .y_mm = 96.1, .half_length_mm = 10, .half_width_mm = 4}));
}

TEST(PanelShares, AreThoseOfTheAreas) {
  const PanelLayout layout =
      panel_with({rectangle(75, 50, 20, 100), ellipse(30, 50, 40, 60), rectangle(0, 0, 20, 20)});
  const auto parts = shares(layout);
  EXPECT_NEAR(share_of(parts, 1), 2000.0 / 15000.0, area_tolerance);
  EXPECT_NEAR(share_of(parts, 2), pi * 600.0 / 15000.0, area_tolerance);
  EXPECT_NEAR(share_of(parts, 3), 100.0 / 15000.0, area_tolerance);  // three quarters lie beside
}

TEST(MapShares, OfAConstantMapAreOne) {
  constexpr double rounding = 1e-15;
  const PanelLayout layout = panel_with_map(Eigen::ArrayXXd::Constant(7, 5, 0.125));
  for (const auto& parts : {shares(layout), shares(layout, spot)}) {
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_NEAR(parts[0].deviation.roughness, 0.125, rounding);
    EXPECT_NEAR(parts[0].weight, 1.0, rounding);
  }
}

/// Values that grow along x from -0.15 to 0.15 over 150 mm.
Eigen::ArrayXXd ramp() {
  Eigen::ArrayXXd values(2, 150);
  for (Eigen::Index i = 0; i < 150; ++i) {
    values.col(i) = (double(i) + 0.5 - 75.0) * 0.002;
  }
  return values;
}

TEST(MapShares, OfALinearMapHaveItsMeanAndVarianceOverTheSpot) {
  constexpr double mean_tolerance = 1e-6;
  // Of an ellipse, (slope a)^2 / 4; groups leave out what varies within one, 1 / 250 of it or so.
  const double variance = std::pow(0.002 * 10.0, 2) / 4.0;
  const double left_out = 0.01 * variance;
  const auto parts = shares(panel_with_map(ramp()), spot);
  EXPECT_LE(parts.size(), 64u);
  EXPECT_NEAR(mean_of(parts, [](double r) { return r; }), 0.0, mean_tolerance);
  EXPECT_NEAR(mean_of(parts, [](double r) { return r * r; }), variance, left_out);
  const auto aside =
      shares(panel_with_map(ramp()),
             Spot{.x_mm = 100, .y_mm = 50, .half_length_mm = 10, .half_width_mm = 4});
  EXPECT_NEAR(mean_of(aside, [](double r) { return r; }), 0.05, mean_tolerance);
}

TEST(MapShares, StartAtTheOriginWithTheFirstRow) {
  Eigen::ArrayXXd values(2, 3);
  values << 1, 2, 3,  //
      4, 5, 6;
  const PanelLayout layout = panel_with_map(values);
  const auto at = [&](double x, double y) {
    return shares(layout, Spot{.x_mm = x, .y_mm = y})[0].deviation.roughness;
  };
  constexpr double of_a_point = 1e-6;
  EXPECT_NEAR(at(25, 25), 1.0, of_a_point);
  EXPECT_NEAR(at(125, 25), 3.0, of_a_point);
  EXPECT_NEAR(at(25, 75), 4.0, of_a_point);
  EXPECT_NEAR(at(50, 50), 3.0, of_a_point);  // between 1, 2, 4 and 5
  EXPECT_NEAR(at(0.1, 0.1), 1.0, of_a_point);
}

TEST(MapShares, OfThreeMapsAndManyValuesAreFew) {
  PanelLayout layout = panel_with({rectangle(75, 50, 20, 100)});
  for (std::size_t p = 0; p < sample_parameter_count; ++p) {
    layout.maps[p].emplace(Eigen::ArrayXXd::NullaryExpr(200, 300,
                                                        [p](Eigen::Index row, Eigen::Index column) {
                                                          const double phase = double(p) + 1.0;
                                                          return std::sin(phase * double(row) +
                                                                          double(column) / phase);
                                                        }),
                           150, 100);
  }
  const auto parts = shares(layout);
  EXPECT_LE(parts.size(), 128u);
  EXPECT_GT(parts.size(), 64u);
  EXPECT_NEAR(share_of(parts, 1), 2000.0 / 15000.0, area_tolerance);
}

}  // namespace
}  // namespace gonio

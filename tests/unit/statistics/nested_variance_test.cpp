#include "emulator/statistics/nested_variance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-12;

using Panel = std::vector<double>;
using Lot = std::vector<Panel>;

NestedSpread spread_of(const std::vector<Lot>& lots) {
  NestedVariance variance;
  for (std::size_t lot = 0; lot < lots.size(); ++lot) {
    for (const Panel& panel : lots[lot]) {
      RunningStatistics statistics;
      std::for_each(panel.begin(), panel.end(), [&](double x) { statistics.add(x); });
      variance.add(lot, panel.size(), statistics.result().mean,
                   statistics.result().standard_deviation);
    }
  }
  return variance.result();
}

double square(double x) { return x * x; }

// Snedecor and Cochran, Statistical Methods (1967), p. 286: calcium in turnip greens, 4 plants of 3
// leaves with 2 determinations each. Data and components as in the SAS/STAT User's Guide, The
// NESTED Procedure, example 1.
TEST(NestedVariance, EqualsTheTurnipGreensOfSnedecorAndCochran) {
  const NestedSpread got = spread_of({{{3.28, 3.09}, {3.52, 3.48}, {2.88, 2.80}},
                                      {{2.46, 2.44}, {1.87, 1.92}, {2.19, 2.19}},
                                      {{2.77, 2.66}, {3.74, 3.44}, {2.55, 2.55}},
                                      {{3.78, 3.87}, {4.07, 4.12}, {3.31, 3.31}}});
  constexpr double printed = 5e-7;  // six decimals
  EXPECT_EQ(got.lots, 4u);
  EXPECT_EQ(got.panels, 12u);
  EXPECT_EQ(got.readings, 24u);
  EXPECT_EQ(got.freedom_lots, 3u);
  EXPECT_EQ(got.freedom_panels, 8u);
  EXPECT_EQ(got.freedom_readings, 12u);
  EXPECT_TRUE(is_close(square(got.sd_lots), 0.365223, printed));
  EXPECT_TRUE(is_close(square(got.sd_panels), 0.161060, printed));
  EXPECT_TRUE(is_close(square(got.sd_readings), 0.006654, printed));
}

// One panel in each lot: a one-way analysis, with n_0 = (N - sum n_i^2 / N) / (a - 1). The numbers
// are worked out by hand: means 2, 5 and 7.5; sums of squares 47.1 between and 2.5 within.
TEST(NestedVariance, OfOnePanelALotIsTheOneWayAnalysis) {
  const NestedSpread got = spread_of({{{1.0, 2.0, 3.0}}, {{5.0}}, {{7.0, 8.0}}});
  const double mean = 26.0 / 6.0;
  const double between = 3.0 * square(2.0 - mean) + square(5.0 - mean) + 2.0 * square(7.5 - mean);
  const double within = (2.0 + 0.5) / 3.0, n_0 = (6.0 - 14.0 / 6.0) / 2.0;
  EXPECT_TRUE(is_close_relative(got.mean, mean, rounding));
  EXPECT_EQ(got.freedom_panels, 0u);
  EXPECT_EQ(got.sd_panels, 0.0);
  EXPECT_TRUE(is_close_relative(square(got.sd_readings), within, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_lots), (between / 2.0 - within) / n_0, rounding));
}

TEST(NestedVariance, WithOneReadingAPanelLeavesAllSpreadToPanels) {
  const NestedSpread got = spread_of({{{1.0}, {3.0}}, {{11.0}, {13.0}}});
  EXPECT_EQ(got.freedom_readings, 0u);
  EXPECT_EQ(got.sd_readings, 0.0);
  EXPECT_TRUE(is_close_relative(square(got.sd_panels), 2.0, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_lots), (100.0 - 2.0) / 2.0, rounding));
}

// The shape of a hierarchy that is not balanced: readings of each panel, by lot.
const std::vector<std::vector<std::size_t>> uneven = {{1, 4, 2}, {3}, {2, 2, 6, 1, 1}, {5, 1}};

std::vector<Lot> drawn(std::mt19937_64& random, double lots, double panels, double readings) {
  std::normal_distribution<double> normal;
  std::vector<Lot> result;
  for (const std::vector<std::size_t>& sizes : uneven) {
    const double of_lot = 50.0 + lots * normal(random);
    Lot lot;
    for (const std::size_t n : sizes) {
      const double of_panel = of_lot + panels * normal(random);
      Panel panel(n);
      std::generate(panel.begin(), panel.end(),
                    [&] { return of_panel + readings * normal(random); });
      lot.push_back(panel);
    }
    result.push_back(lot);
  }
  return result;
}

// Seed 17; 20000 hierarchies. What is negative is cut off, which does bias a mean: with these
// components that is rarer than one in a hundred, and less than what the means are known to.
TEST(NestedVariance, RecoversWhatWasPlantedWithoutBias) {
  constexpr double standard_errors = 4.0;
  std::mt19937_64 random(17);
  RunningStatistics lots, panels, readings;
  for (std::size_t i = 0; i < test::trials(20000); ++i) {
    const NestedSpread got = spread_of(drawn(random, 10.0, 2.0, 1.0));
    lots.add(square(got.sd_lots));
    panels.add(square(got.sd_panels));
    readings.add(square(got.sd_readings));
  }
  const auto expect_mean = [](const RunningStatistics& got, double planted) {
    const ChannelStatistics& of = got.result();
    EXPECT_TRUE(is_close(of.mean, planted,
                         standard_errors * of.standard_deviation / std::sqrt(double(of.n))));
  };
  expect_mean(lots, 100.0);
  expect_mean(panels, 4.0);
  expect_mean(readings, 1.0);
}

// Seed 23.
TEST(NestedVariance, IsNotMovedByTheOrderOfLots) {
  std::mt19937_64 random(23);
  std::vector<Lot> lots = drawn(random, 3.0, 2.0, 1.0);
  const NestedSpread given = spread_of(lots);
  std::reverse(lots.begin(), lots.end());
  std::reverse(lots[0].begin(), lots[0].end());
  const NestedSpread turned = spread_of(lots);
  EXPECT_TRUE(is_close_relative(turned.mean, given.mean, rounding));
  EXPECT_TRUE(is_close_relative(turned.sd_lots, given.sd_lots, rounding));
  EXPECT_TRUE(is_close_relative(turned.sd_panels, given.sd_panels, rounding));
  EXPECT_TRUE(is_close_relative(turned.sd_readings, given.sd_readings, rounding));
}

TEST(NestedVariance, CountsNegativeEstimatesAsNone) {
  // Panels and lots have the same means: readings alone differ.
  const NestedSpread got = spread_of({{{1.0, 3.0}, {0.0, 4.0}}, {{2.0, 2.0}, {1.5, 2.5}}});
  EXPECT_GT(got.sd_readings, 0.0);
  EXPECT_EQ(got.sd_panels, 0.0);
  EXPECT_EQ(got.sd_lots, 0.0);
}

TEST(NestedVariance, OfEqualReadingsIsExactlyNone) {
  const NestedSpread got =
      spread_of({{{83.3, 83.3}, {83.3}}, {{83.3, 83.3, 83.3}}, {{83.3}, {83.3}}});
  EXPECT_EQ(got.mean, 83.3);
  EXPECT_EQ(got.sd_lots, 0.0);
  EXPECT_EQ(got.sd_panels, 0.0);
  EXPECT_EQ(got.sd_readings, 0.0);
}

TEST(NestedVariance, CanBeAskedAtAnyTime) {
  NestedVariance variance;
  EXPECT_EQ(variance.result().panels, 0u);
  variance.add(7, 2, 1.0, 0.5);
  EXPECT_EQ(variance.result().lots, 1u);
  EXPECT_EQ(variance.result().mean, 1.0);
  EXPECT_TRUE(is_close_relative(variance.result().sd_readings, 0.5, rounding));
  variance.add(7, 2, 2.0, 0.5);
  variance.add(8, 2, 2.0, 0.5);
  EXPECT_EQ(variance.result().lots, 2u);
  EXPECT_EQ(variance.result().panels, 3u);
  EXPECT_EQ(variance.result().readings, 6u);
}

TEST(NestedVariance, RefusesPanelsWithoutReadings) {
  NestedVariance variance;
  EXPECT_THROW(variance.add(1, 0, 1.0, 0.0), std::domain_error);
  EXPECT_THROW(variance.add(1, 1, std::numeric_limits<double>::quiet_NaN(), 0.0),
               std::domain_error);
  EXPECT_THROW(variance.add(1, 2, 1.0, -0.1), std::domain_error);
  EXPECT_EQ(variance.result().readings, 0u);
}

}  // namespace
}  // namespace gonio

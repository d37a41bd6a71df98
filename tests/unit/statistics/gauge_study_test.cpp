#include "emulator/statistics/gauge_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-10;

double square(double x) { return x * x; }

// AIAG, Measurement Systems Analysis, the data of the study that the whole chapter uses: 10 parts,
// appraisers A, B and C, 3 trials each.
GaugeReadings manual() {
  return {.parts = 10,
          .appraisers = 3,
          .repetitions = 3,
          .values = {0.29,  0.41,  0.64,  0.08,  0.25,  0.07,  0.04,  -0.11, -0.15,  //
                     -0.56, -0.68, -0.58, -0.47, -1.22, -0.68, -1.38, -1.13, -0.96,  //
                     1.34,  1.17,  1.27,  1.19,  0.94,  1.34,  0.88,  1.09,  0.67,   //
                     0.47,  0.50,  0.64,  0.01,  1.03,  0.20,  0.14,  0.20,  0.11,   //
                     -0.80, -0.92, -0.84, -0.56, -1.20, -1.28, -1.46, -1.07, -1.45,  //
                     0.02,  -0.11, -0.21, -0.20, 0.22,  0.06,  -0.29, -0.67, -0.49,  //
                     0.59,  0.75,  0.66,  0.47,  0.55,  0.83,  0.02,  0.01,  0.21,   //
                     -0.31, -0.20, -0.17, -0.63, 0.08,  -0.34, -0.46, -0.56, -0.49,  //
                     2.26,  1.99,  2.01,  1.80,  2.12,  2.19,  1.77,  1.45,  1.87,   //
                     -1.36, -1.25, -1.31, -1.68, -1.62, -1.50, -1.49, -1.77, -2.16}};
}

// The table of the manual, sums of squares to four decimals; F and p of the interaction as Minitab
// prints them for the same data (Example of Crossed Gage R&R Study).
TEST(GaugeStudy, HasTheAnovaTableOfTheManual) {
  constexpr double printed = 0.00005, printed_f = 0.0005;
  const GaugeStudy got = gauge_study(manual());
  EXPECT_TRUE(is_close(got.part.sum_of_squares, 88.3619, printed));
  EXPECT_TRUE(is_close(got.appraiser.sum_of_squares, 3.1673, printed));
  EXPECT_TRUE(is_close(got.interaction.sum_of_squares, 0.3590, printed));
  EXPECT_TRUE(is_close(got.repeatability.sum_of_squares, 2.7589, printed));
  EXPECT_TRUE(is_close(got.total.sum_of_squares, 94.6471, printed));
  EXPECT_EQ(got.part.degrees_of_freedom, 9u);
  EXPECT_EQ(got.appraiser.degrees_of_freedom, 2u);
  EXPECT_EQ(got.interaction.degrees_of_freedom, 18u);
  EXPECT_EQ(got.repeatability.degrees_of_freedom, 60u);
  EXPECT_EQ(got.total.degrees_of_freedom, 89u);
  EXPECT_TRUE(is_close(got.interaction.f.value(), 0.434, printed_f));
  EXPECT_TRUE(is_close(got.interaction.p.value(), 0.974, printed_f));
  EXPECT_FALSE(got.repeatability.f || got.total.f);
}

// What Minitab prints for these data, interaction removed, tolerance 8: variances to five decimals,
// percentages to two.
TEST(GaugeStudy, HasTheComponentsThatMinitabPrints) {
  constexpr double printed = 0.00001, percent = 0.005;
  const GaugeStudy got = gauge_study(manual(), 8.0);
  EXPECT_TRUE(got.interaction_pooled);
  EXPECT_TRUE(is_close(square(got.sd_repeatability), 0.03997, printed));
  EXPECT_TRUE(is_close(square(got.sd_reproducibility), 0.05146, printed));
  EXPECT_TRUE(is_close(square(got.sd_gauge), 0.09143, printed));
  EXPECT_TRUE(is_close(square(got.sd_part), 1.08645, printed));
  EXPECT_TRUE(is_close(square(got.sd_total), 1.17788, printed));
  EXPECT_TRUE(is_close(got.percent_of_study, 27.86, percent));
  EXPECT_TRUE(is_close(got.percent_contribution, 7.76, percent));
  EXPECT_TRUE(is_close(got.percent_of_tolerance.value(), 22.68, percent));
  EXPECT_EQ(got.sd_interaction, 0.0);
  EXPECT_EQ(got.sd_appraiser, got.sd_reproducibility);
  EXPECT_EQ(got.distinct_categories, 4);
}

// Two of each, every effect up or down: the sum of squares of each is 8 times its square.
GaugeReadings signs(double part, double appraiser, double interaction, double repetition) {
  GaugeReadings readings{.parts = 2, .appraisers = 2, .repetitions = 2};
  for (const double i : {-1.0, 1.0}) {
    for (const double j : {-1.0, 1.0}) {
      for (const double k : {-1.0, 1.0}) {
        readings.values.push_back(100.0 + i * part + j * appraiser + i * j * interaction +
                                  k * repetition);
      }
    }
  }
  return readings;
}

TEST(GaugeStudy, OfSignsHasClosedForms) {
  const GaugeStudy got = gauge_study(signs(30.0, 10.0, 2.0, 0.5));
  EXPECT_FALSE(got.interaction_pooled);
  EXPECT_TRUE(is_close_relative(got.part.mean_square, 7200.0, rounding));
  EXPECT_TRUE(is_close_relative(got.appraiser.mean_square, 800.0, rounding));
  EXPECT_TRUE(is_close_relative(got.interaction.mean_square, 32.0, rounding));
  EXPECT_TRUE(is_close_relative(got.repeatability.mean_square, 0.5, rounding));
  EXPECT_TRUE(is_close_relative(got.part.f.value(), 225.0, rounding));
  EXPECT_TRUE(is_close_relative(got.appraiser.f.value(), 25.0, rounding));
  EXPECT_TRUE(is_close_relative(got.interaction.f.value(), 64.0, rounding));
  // F of (1, 1): p = 1 - 2 / pi atan(sqrt(F)).
  EXPECT_TRUE(is_close_relative(got.appraiser.p.value(),
                                1.0 - 2.0 / std::acos(-1.0) * std::atan(5.0), rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_repeatability), 0.5, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_interaction), (32.0 - 0.5) / 2.0, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_appraiser), (800.0 - 32.0) / 4.0, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_part), (7200.0 - 32.0) / 4.0, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_reproducibility), 192.0 + 15.75, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_gauge), 192.0 + 15.75 + 0.5, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_total), 192.0 + 15.75 + 0.5 + 1792.0, rounding));
}

// F of (1, 4): p = 0.25 at F = 1.8074.
TEST(GaugeStudy, PoolsAnInteractionWithPAbove25Percent) {
  const GaugeStudy apart = gauge_study(signs(30.0, 10.0, std::sqrt(1.82), 2.0));
  const GaugeStudy pooled = gauge_study(signs(30.0, 10.0, std::sqrt(1.79), 2.0));
  EXPECT_LT(apart.interaction.p.value(), 0.25);
  EXPECT_FALSE(apart.interaction_pooled);
  EXPECT_GT(pooled.interaction.p.value(), 0.25);
  EXPECT_TRUE(pooled.interaction_pooled);
  const double together = (8.0 * 1.79 + 8.0 * 4.0) / 5.0;
  EXPECT_TRUE(is_close_relative(square(pooled.sd_repeatability), together, rounding));
  EXPECT_TRUE(is_close_relative(pooled.part.f.value(), 7200.0 / together, rounding));
  EXPECT_TRUE(is_close_relative(square(pooled.sd_part), (7200.0 - together) / 4.0, rounding));
  EXPECT_EQ(pooled.sd_interaction, 0.0);
}

TEST(GaugeStudy, AddsUpToTheTotal) {
  for (const GaugeReadings& readings : {manual(), signs(1.0, 2.0, 3.0, 4.0)}) {
    const GaugeStudy got = gauge_study(readings);
    EXPECT_TRUE(is_close_relative(got.part.sum_of_squares + got.appraiser.sum_of_squares +
                                      got.interaction.sum_of_squares +
                                      got.repeatability.sum_of_squares,
                                  got.total.sum_of_squares, rounding));
    EXPECT_EQ(got.part.degrees_of_freedom + got.appraiser.degrees_of_freedom +
                  got.interaction.degrees_of_freedom + got.repeatability.degrees_of_freedom,
              got.total.degrees_of_freedom);
  }
}

TEST(GaugeStudy, IsMovedByNoOffset) {
  GaugeReadings moved = manual();
  for (double& value : moved.values) {
    value += 1e6;
  }
  // 1e6 + 0.01 keeps ten decimals.
  constexpr double digits_left = 1e-8;
  EXPECT_TRUE(
      is_close_relative(gauge_study(moved).sd_gauge, gauge_study(manual()).sd_gauge, digits_left));
}

TEST(GaugeStudy, OfOneAppraiserKnowsNoReproducibility) {
  const GaugeStudy got = gauge_study(
      {.parts = 3, .appraisers = 1, .repetitions = 2, .values = {1.0, 2.0, 5.0, 6.0, 9.0, 10.0}});
  EXPECT_EQ(got.appraiser.degrees_of_freedom, 0u);
  EXPECT_EQ(got.interaction.degrees_of_freedom, 0u);
  EXPECT_EQ(got.appraiser.sum_of_squares, 0.0);
  EXPECT_EQ(got.interaction.sum_of_squares, 0.0);
  EXPECT_FALSE(got.appraiser.f || got.interaction.f || got.interaction_pooled);
  EXPECT_EQ(got.sd_reproducibility, 0.0);
  EXPECT_EQ(got.sd_gauge, got.sd_repeatability);
  EXPECT_TRUE(is_close_relative(square(got.sd_repeatability), 0.5, rounding));
  // Mean square of parts: 2 (16 + 0 + 16) / 2 = 32.
  EXPECT_TRUE(is_close_relative(got.part.f.value(), 64.0, rounding));
  EXPECT_TRUE(is_close_relative(square(got.sd_part), (32.0 - 0.5) / 2.0, rounding));
}

TEST(GaugeStudy, CountsNegativeEstimatesAsNone) {
  const GaugeStudy got = gauge_study(signs(0.1, 0.1, 3.0, 1.0));
  EXPECT_LT(got.part.mean_square, got.interaction.mean_square);
  EXPECT_EQ(got.sd_part, 0.0);
  EXPECT_EQ(got.sd_appraiser, 0.0);
  EXPECT_GT(got.sd_interaction, 0.0);
  EXPECT_EQ(got.percent_of_study, 100.0);
  EXPECT_EQ(got.distinct_categories, 1);
}

TEST(GaugeStudy, OfEqualReadingsHasNoSpread) {
  const GaugeStudy got = gauge_study(
      {.parts = 2, .appraisers = 2, .repetitions = 2, .values = std::vector<double>(8, 83.3)}, 5.0);
  EXPECT_EQ(got.total.sum_of_squares, 0.0);
  EXPECT_EQ(got.sd_total, 0.0);
  EXPECT_EQ(got.percent_of_study, 0.0);
  EXPECT_EQ(got.percent_of_tolerance, 0.0);
  EXPECT_EQ(got.distinct_categories, 1);
  EXPECT_FALSE(got.part.f);
}

TEST(GaugeStudy, OfAGaugeWithoutSpreadTellsAsManyCategoriesAsThereAre) {
  const GaugeStudy got = gauge_study(signs(3.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(got.sd_gauge, 0.0);
  EXPECT_EQ(got.distinct_categories, most_distinct_categories);
}

// Seed 29; 4000 studies of 5 parts, 2 appraisers, 3 repetitions, without an interaction or with one
// that is plain. The interval is exact where nothing is pooled.
TEST(GaugeStudy, IntervalOfRepeatabilityHoldsTheTruthAsOftenAsItSays) {
  const std::size_t studies = test::trials(4000);
  std::mt19937_64 random(29);
  std::normal_distribution<double> normal;
  std::size_t held = 0;
  for (std::size_t study = 0; study < studies; ++study) {
    GaugeReadings readings{.parts = 5, .appraisers = 2, .repetitions = 3};
    for (std::size_t cell = 0; cell < 10; ++cell) {
      const double mean = 20.0 * normal(random);
      for (std::size_t i = 0; i < 3; ++i) {
        readings.values.push_back(mean + 0.3 * normal(random));
      }
    }
    const GaugeStudy got = gauge_study(readings);
    ASSERT_FALSE(got.interaction_pooled);
    held += got.repeatability_interval->low <= 0.3 && 0.3 <= got.repeatability_interval->high;
  }
  EXPECT_TRUE(
      is_close(double(held) / double(studies), 0.95, test::chance_about_95_percent(studies, 4.0)));
}

TEST(GaugeStudy, RefusesWhatDoesNotFit) {
  const auto message = [](const GaugeReadings& readings, std::optional<double> tolerance = {}) {
    return test::message_of([&] { (void)gauge_study(readings, tolerance); });
  };
  GaugeReadings readings = signs(1.0, 1.0, 1.0, 1.0);
  readings.values.pop_back();
  EXPECT_EQ(message(readings),
            "gauge_study: expected two parts, an appraiser, two repetitions or more and a value of "
            "each, found 2, 2, 2 and 7 values");
  readings.values.push_back(std::numeric_limits<double>::infinity());
  EXPECT_EQ(message(readings), "gauge_study: expected finite values, found inf");
  EXPECT_EQ(message(signs(1.0, 1.0, 1.0, 1.0), 0.0),
            "gauge_study: expected a tolerance > 0, found 0");
  EXPECT_THROW(
      (void)gauge_study({.parts = 1, .appraisers = 2, .repetitions = 2, .values = {1, 2, 3, 4}}),
      std::invalid_argument);
  EXPECT_THROW(
      (void)gauge_study({.parts = 2, .appraisers = 2, .repetitions = 1, .values = {1, 2, 3, 4}}),
      std::invalid_argument);
  EXPECT_THROW((void)gauge_study({.parts = 2, .appraisers = 0, .repetitions = 2, .values = {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace gonio

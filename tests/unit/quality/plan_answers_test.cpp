#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "emulator/quality/risk_study.hpp"
#include "emulator/statistics/sampling_plan.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/quality/normal_batch.hpp"
#include "tests/unit/quality/normal_source.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using Kind = AcceptanceRule::Kind;
using test::allows;
using test::batch_of;
using test::is_close_relative;
using test::normal_source;
using test::uncertainties_of;

const Interval both{.low = 80.0, .high = 90.0};

std::vector<std::uint64_t> numbers(const ReadingsAnswer& answer) {
  std::vector<std::uint64_t> result;
  for (const auto& row : answer.rows) {
    result.push_back(row.readings);
  }
  return result;
}

Batch with_positions(std::size_t n) {
  Batch batch = batch_of(both);
  batch.plan.positions.clear();
  for (std::size_t i = 0; i < n; ++i) {
    batch.plan.positions.push_back({.x_mm = 10.0 * double(i + 1), .y_mm = 50.0});
  }
  return batch;
}

// How many readings.

// One panel a lot, by its mean: risks of a lot are those of JCGM 106 with u = sd / sqrt(n).
TEST(ReadingsForRisk, FollowsJcgm106) {
  Batch batch = batch_of(both);
  batch.plan.panels = 1;
  batch.plan.accept.kind = Kind::mean;
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalProduct product{{{.mean = 87.0, .sd_lots = 2.0, .sd_readings = 4.0}}};
  const std::size_t lots = test::trials(20000);
  const auto exact = [&](std::uint64_t n) {
    return global_risks(87.0, 2.0, 4.0 / std::sqrt(double(n)), both, both);
  };
  const double risk = 0.5 * (exact(4).producer + exact(6).producer);
  const ReadingsAnswer answer =
      readings_for_risk(batch, uncertainties, normal_source(uncertainties, product),
                        {.lots_per_point = lots, .risk = risk});
  EXPECT_EQ(answer.needed, 6U);
  EXPECT_EQ(answer.present, 1U);
  EXPECT_EQ(answer.risk, risk);
  EXPECT_EQ(numbers(answer), (std::vector<std::uint64_t>{1, 2, 3, 4, 6}));
  double last = 1.0;
  for (const auto& row : answer.rows) {
    EXPECT_TRUE(allows(row.producer, lots, exact(row.readings).producer)) << row.readings;
    EXPECT_TRUE(allows(row.consumer, lots, exact(row.readings).consumer)) << row.readings;
    const double both_risks = row.producer.value + row.consumer.value;
    EXPECT_LT(both_risks, last);
    last = both_risks;
  }
}

TEST(ReadingsForRisk, ShowsFourRowsAndThePresentOneEvenIfOneIsEnough) {
  Batch batch = with_positions(6);
  batch.plan.repetitions = 2;
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const ReadingsAnswer answer =
      readings_for_risk(batch, uncertainties, normal_source(uncertainties, {{{.mean = 85.0}}}),
                        {.lots_per_point = 10});
  EXPECT_EQ(answer.needed, 1U);
  EXPECT_EQ(answer.present, 12U);
  EXPECT_EQ(numbers(answer), (std::vector<std::uint64_t>{1, 2, 3, 4, 6, 12}));
}

TEST(ReadingsForRisk, SaysSoIfNoNumberIsEnough) {
  const Batch batch = with_positions(5);
  // An error that all readings share does not average out.
  const ReadingUncertainties uncertainties = uncertainties_of(batch, {.systematic = 5.0});
  const ReadingsAnswer answer = readings_for_risk(
      batch, uncertainties,
      normal_source(uncertainties, {{{.mean = 88.0, .sd_lots = 2.0, .sd_readings = 0.5}}}),
      {.lots_per_point = 200});
  EXPECT_FALSE(answer.needed);
  EXPECT_EQ(numbers(answer), (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 10, 15, 20, 25}));
}

TEST(ReadingsForRisk, TriesNoFewerThanTheStandardAsksFor) {
  Batch batch = with_positions(3);
  batch.standard.readings = ReadingRule{.count = {.at_least = 3}};
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const ReadingsAnswer answer =
      readings_for_risk(batch, uncertainties, normal_source(uncertainties, {{{.mean = 85.0}}}),
                        {.lots_per_point = 10});
  EXPECT_EQ(answer.needed, 3U);
  EXPECT_EQ(numbers(answer), (std::vector<std::uint64_t>{3, 6, 9, 12}));
}

TEST(ReadingsForRisk, SpreadsReadingsOverThePositions) {
  const Batch batch = with_positions(6);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  std::vector<SamplingPlan> plans;
  const PanelSourceFactory source = [&](const Batch& changed) {
    plans.push_back(changed.plan);
    return std::make_unique<NormalPanels>(changed, uncertainties, NormalProduct{{{.mean = 85.0}}});
  };
  const ReadingsAnswer answer =
      readings_for_risk(batch, uncertainties, source, {.lots_per_point = 10, .risk = 0.0});
  ASSERT_GE(plans.size(), 4U);
  const auto places = [](const SamplingPlan& plan) {
    std::vector<double> x;
    for (const PanelPlace& place : plan.positions) {
      x.push_back(place.x_mm);
    }
    return x;
  };
  EXPECT_EQ(places(plans[0]), (std::vector<double>{40.0}));
  EXPECT_EQ(places(plans[1]), (std::vector<double>{20.0, 50.0}));
  EXPECT_EQ(places(plans[2]), (std::vector<double>{20.0, 40.0, 60.0}));
  EXPECT_EQ(answer.rows.size(), plans.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    EXPECT_EQ(plans[i].positions.size() * plans[i].repetitions, answer.rows[i].readings);
  }
}

// How much spread.

/// A source that takes the spread of the roughness for that of the gloss, in GU.
PanelSourceFactory gloss_for_roughness(const ReadingUncertainties& uncertainties, double mean) {
  return [&uncertainties, mean](const Batch& batch) {
    const ParameterSpread& spread = batch.product.value().spread[0];
    return std::make_unique<NormalPanels>(
        batch, uncertainties,
        NormalProduct{{{.mean = mean,
                        .sd_lots = spread.lots.standard_uncertainty,
                        .sd_panels = spread.panels.standard_uncertainty,
                        .sd_readings = spread.within_panel}}});
  };
}

Batch varying(const Interval& limits, double lots, double panels) {
  Batch batch = batch_of(limits);
  batch.plan.panels = 1;
  batch.product = Product{};
  batch.product->spread[0].lots.standard_uncertainty = lots;
  batch.product->spread[0].panels.standard_uncertainty = panels;
  return batch;
}

// One panel of a lot, none may fail: refused is what is beyond, 5 % at 1.96 standard deviations.
TEST(SpreadForRisk, EqualsTheClosedForm) {
  const std::size_t lots = test::trials(20000);
  // 2 % of the search, and what the share of so many lots is sure to: it grows 4.6 times as fast as
  // the spread.
  const double tolerance = 0.02 + 5.0 * std::sqrt(0.95 / 0.05 / double(lots)) / 4.6;
  for (const double present : {1.2, 2.0, 6.0}) {
    const Batch batch = varying(both, 0.8 * present, 0.6 * present);
    const ReadingUncertainties uncertainties = uncertainties_of(batch);
    const SpreadAnswer answer =
        spread_for_risk(batch, 0, uncertainties, gloss_for_roughness(uncertainties, 85.0),
                        {.lots_per_point = lots});
    EXPECT_EQ(answer.parameter, "roughness");
    EXPECT_TRUE(is_close_relative(answer.present, present, 1e-12));
    ASSERT_TRUE(answer.allowed);
    EXPECT_FALSE(answer.unlimited);
    EXPECT_TRUE(is_close_relative(*answer.allowed, 5.0 / 1.959964, tolerance));
    EXPECT_EQ(answer.rows.front().spread, 0.0);
    double last = -1.0;
    for (const auto& row : answer.rows) {
      const double exact = beyond_limits(85.0, row.spread, both);
      EXPECT_TRUE(allows(row.refused, lots, exact));
      EXPECT_EQ(row.beyond, row.refused.value);
      EXPECT_GT(row.spread, last);
      last = row.spread;
    }
  }
}

TEST(SpreadForRisk, AllowsNoneWhereEvenNoneIsTooMuch) {
  const Batch batch = varying(both, 1.0, 0.0);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const SpreadAnswer answer = spread_for_risk(
      batch, 0, uncertainties, gloss_for_roughness(uncertainties, 95.0), {.lots_per_point = 100});
  EXPECT_FALSE(answer.allowed);
  EXPECT_FALSE(answer.unlimited);
  ASSERT_EQ(answer.rows.size(), 1U);
  EXPECT_EQ(answer.rows[0].refused.value, 1.0);
}

TEST(SpreadForRisk, SaysSoIfNoSpreadThatItTriesIsTooMuch) {
  const Batch batch = varying({.low = 0.0}, 1.0, 0.0);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const SpreadAnswer answer = spread_for_risk(
      batch, 0, uncertainties, gloss_for_roughness(uncertainties, 85.0), {.lots_per_point = 100});
  EXPECT_TRUE(answer.unlimited);
  EXPECT_EQ(answer.rows.back().spread, largest_spread_factor);
  EXPECT_EQ(answer.allowed, largest_spread_factor);
}

TEST(SpreadForRisk, AllowsAlmostNothingWhereAllButNothingIsTooMuch) {
  // The mean lies on the limit.
  const Batch batch = varying({.low = 85.0}, 1.0, 0.0);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const SpreadAnswer answer = spread_for_risk(
      batch, 0, uncertainties, gloss_for_roughness(uncertainties, 85.0), {.lots_per_point = 100});
  ASSERT_TRUE(answer.allowed);
  EXPECT_EQ(*answer.allowed, 0.0);
}

TEST(SpreadForRisk, RefusesAParameterThatDoesNotVary) {
  const Batch batch = varying(both, 1.0, 0.0);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const PanelSourceFactory source = gloss_for_roughness(uncertainties, 85.0);
  EXPECT_THROW((void)spread_for_risk(batch, 1, uncertainties, source, {}), std::invalid_argument);
  EXPECT_THROW((void)spread_for_risk(batch, 3, uncertainties, source, {}), std::invalid_argument);
  EXPECT_THROW((void)spread_for_risk(batch_of(both), 0, uncertainties, source, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace gonio

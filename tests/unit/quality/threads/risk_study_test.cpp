#include "emulator/quality/risk_study.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <vector>

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

Risks risks_of(const Batch& batch, const ReadingUncertainty& each, const NormalProduct& product,
               std::uint64_t lots = test::trials(4000)) {
  const ReadingUncertainties uncertainties = uncertainties_of(batch, each);
  return risks(batch, uncertainties, normal_source(uncertainties, product), {.lots = lots});
}

// Of panels: JCGM 106.

TEST(Risks, OfPanelsAreThoseOfJcgm106) {
  // One panel a lot, so that all errors are independent.
  Batch batch = batch_of(both);
  batch.plan.panels = 1;
  batch.plan.repetitions = 4;
  batch.decision.rule = DecisionRule::guarded;
  const std::size_t lots = test::trials(40000);
  for (const double guard : {0.0, 1.0}) {
    batch.decision.guard_band_factor = guard;
    const Risks found =
        risks_of(batch, {.systematic = 0.6, .expanded = 1.2},
                 {{{.mean = 87.0, .sd_lots = 1.2, .sd_panels = 1.6, .sd_readings = 1.6}}}, lots);
    const Interval acceptance{.low = 80.0 + 1.2 * guard, .high = 90.0 - 1.2 * guard};
    const GlobalRisks exact = global_risks(87.0, 2.0, 1.0, both, acceptance);
    EXPECT_TRUE(allows(found.panel.producer, lots, exact.producer));
    EXPECT_TRUE(allows(found.panel.consumer, lots, exact.consumer));
    EXPECT_TRUE(allows(found.panel.conforming, lots, within_limits(87.0, 2.0, both)));
    EXPECT_TRUE(
        allows(found.panel.accepted, lots, within_limits(87.0, std::sqrt(5.0), acceptance)));
    // The formula with the moments of the same simulation: these have a standard error of
    // 1 / sqrt(2 n), to which the risks answer with a few times as much.
    const double of_moments = 20.0 / std::sqrt(2.0 * double(lots));
    ASSERT_TRUE(found.panel_normal);
    EXPECT_TRUE(is_close_relative(found.panel_normal->producer, exact.producer, of_moments));
    EXPECT_TRUE(is_close_relative(found.panel_normal->consumer, exact.consumer, of_moments));
  }
}

TEST(Risks, AreNoneWithoutErrorsOfMeasurement) {
  Batch batch = batch_of(both);
  const NormalProduct product{{{.mean = 88.0, .sd_lots = 1.0, .sd_panels = 1.0}}};
  const Risks found = risks_of(batch, {}, product);
  EXPECT_EQ(found.panel.producer.value, 0.0);
  EXPECT_EQ(found.panel.consumer.value, 0.0);
  EXPECT_GT(found.panel.conforming.value, 0.8);
  EXPECT_LT(found.panel.conforming.value, 1.0);
  // Lots whose panels are all alike are what their mean is.
  batch.plan.accept.kind = Kind::mean;
  const Risks even = risks_of(batch, {}, {{{.mean = 88.0, .sd_lots = 2.0}}});
  EXPECT_EQ(even.lot.producer.value, 0.0);
  EXPECT_EQ(even.lot.consumer.value, 0.0);
  EXPECT_EQ(even.lots, test::trials(4000));
  EXPECT_EQ(even.panels, 5 * test::trials(4000));
}

TEST(Risks, AreAQuarterEachWhereReadingsTellNothing) {
  Batch batch = batch_of({.low = 85.0});
  batch.plan.panels = 1;
  const std::size_t lots = test::trials(20000);
  const Risks found =
      risks_of(batch, {}, {{{.mean = 85.0, .sd_panels = 1.0, .sd_readings = 1e6}}}, lots);
  EXPECT_TRUE(allows(found.panel.producer, lots, 0.25));
  EXPECT_TRUE(allows(found.panel.consumer, lots, 0.25));
}

TEST(Risks, MoveFromTheConsumerToTheProducerWithTheGuardBand) {
  Batch batch = batch_of(both);
  batch.decision.rule = DecisionRule::guarded;
  double consumer = 1.0, producer = -1.0;
  for (const double guard : {0.0, 0.25, 0.5, 1.0}) {
    batch.decision.guard_band_factor = guard;
    const Risks found = risks_of(batch, {.systematic = 0.5, .expanded = 1.0},
                                 {{{.mean = 89.0, .sd_lots = 1.0, .sd_panels = 1.5}}});
    EXPECT_LT(found.panel.consumer.value, consumer);
    EXPECT_GT(found.panel.producer.value, producer);
    consumer = found.panel.consumer.value;
    producer = found.panel.producer.value;
  }
}

// Of lots.

TEST(Risks, OfLotsByTheMeanAreThoseOfJcgm106) {
  Batch batch = batch_of(both);
  batch.plan.accept.kind = Kind::mean;
  batch.plan.panels = 4;
  const std::size_t lots = test::trials(20000);
  const Risks found = risks_of(batch, {.systematic = 0.6},
                               {{{.mean = 87.0, .sd_lots = 2.0, .sd_panels = 1.6}}}, lots);
  const GlobalRisks exact = global_risks(87.0, 2.0, 1.0, both, both);
  EXPECT_TRUE(allows(found.lot.producer, lots, exact.producer));
  EXPECT_TRUE(allows(found.lot.consumer, lots, exact.consumer));
}

// At most 2.275 % of panels lie above the limit where the mean is two standard deviations below.
TEST(Risks, CountALotAsConformingByItsShareBeyond) {
  Batch batch = batch_of({.high = 90.0});
  batch.plan.acceptable_share = beyond_limits(0.0, 1.0, {.high = 2.0});
  const std::size_t lots = test::trials(20000);
  const Risks found =
      risks_of(batch, {}, {{{.mean = 85.0, .sd_lots = 2.0, .sd_panels = 1.5}}}, lots);
  EXPECT_TRUE(allows(found.lot.conforming, lots, within_limits(85.0, 2.0, {.high = 87.0})));
}

TEST(Risks, AskOnlyOfTheSelectedGeometry) {
  Batch batch = batch_of({.low = 80.0}, {"20", "60"});
  // By the standard 60 deg is right below 70 GU: the limit at 20 deg does not count.
  const NormalProduct product{{{.mean = 5.0, .sd_panels = 0.1}, {.mean = 40.0, .sd_panels = 0.1}}};
  const Risks all = risks_of(batch, {}, product);
  EXPECT_EQ(all.lot.accepted.value, 0.0);
  EXPECT_EQ(all.panel.conforming.value, 0.0);
  batch.selected_only = true;
  const Risks selected = risks_of(batch, {}, product);
  EXPECT_EQ(selected.lot.accepted.value, 1.0);
  EXPECT_EQ(selected.lot.conforming.value, 1.0);
  EXPECT_EQ(selected.panel.conforming.value, 1.0);
}

TEST(Risks, HaveNoNormalModelWithoutLimits) {
  const Risks found = risks_of(batch_of({}), {}, {{{.mean = 85.0, .sd_panels = 1.0}}});
  EXPECT_FALSE(found.panel_normal);
  EXPECT_EQ(found.lot.producer.value, 0.0);
}

TEST(Risks, SpeakOfTheChannelWithTheLeastRoom) {
  Batch batch = batch_of({.low = 0.0}, {"20", "60"});
  batch.requirements.push_back({.channel = 1, .limits = {.low = 85.0}});
  const NormalProduct product{{{.mean = 80.0, .sd_panels = 1.0, .sd_readings = 1.0},
                               {.mean = 85.0, .sd_panels = 1.0, .sd_readings = 1.0}}};
  const Risks found = risks_of(batch, {}, product);
  ASSERT_TRUE(found.panel_normal);
  // At the limit with u = sd: one in eight is either.
  EXPECT_NEAR(found.panel_normal->producer, 0.125, 0.01);
}

// All of them.

TEST(RiskStudy, TellsHowFarItIsOneCallAtATime) {
  const Batch batch = batch_of(both);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  std::vector<std::size_t> done;
  std::size_t last_total = 0;
  const RiskOptions options{.lots = 100, .advance = [&](const char* work, auto so_far, auto total) {
                              EXPECT_STREQ(work, "risks");
                              done.push_back(so_far);
                              last_total = total;
                            }};
  (void)risks(batch, uncertainties, normal_source(uncertainties, {{{.mean = 85.0}}}), options);
  ASSERT_FALSE(done.empty());
  for (std::size_t i = 0; i < done.size(); ++i) {
    EXPECT_EQ(done[i], i + 1);
  }
  EXPECT_EQ(done.back(), last_total);
}

/// Every study, as numbers.
std::vector<double> all_studies(std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Batch batch = batch_of(both);
  batch.product = Product{};
  batch.product->spread[0].panels.standard_uncertainty = 1.0;
  const ReadingUncertainties uncertainties = uncertainties_of(batch, {.systematic = 0.5});
  const NormalProduct product{
      {{.mean = 88.0, .sd_lots = 1.0, .sd_panels = 1.0, .sd_readings = 1.0}}};
  const PanelSourceFactory source = normal_source(uncertainties, product);
  const RiskOptions options{.lots = 300, .lots_per_point = 100};
  std::vector<double> numbers;
  const auto keep = [&](const Estimate& estimate) {
    numbers.insert(numbers.end(), {estimate.value, estimate.low, estimate.high});
  };
  const Risks found = risks(batch, uncertainties, source, options);
  keep(found.lot.producer);
  keep(found.panel.consumer);
  numbers.push_back(found.panel_normal.value().consumer);
  const OcCurve curve = operating_characteristic(batch, uncertainties,
                                                 {.low = -10.0,
                                                  .high = 4.0,
                                                  .shifted =
                                                      [&](double offset) {
                                                        NormalProduct moved = product;
                                                        moved.channels[0].mean += offset;
                                                        return std::make_unique<NormalPanels>(
                                                            batch, uncertainties, moved);
                                                      }},
                                                 options);
  for (const OcPoint& point : curve.points) {
    numbers.insert(numbers.end(), {point.offset, point.mean, point.beyond, point.exact.value()});
    keep(point.accepted);
  }
  for (const auto& row : readings_for_risk(batch, uncertainties, source, options).rows) {
    keep(row.producer);
  }
  for (const auto& row : spread_for_risk(batch, 0, uncertainties, source, options).rows) {
    keep(row.refused);
  }
  return numbers;
}

TEST(RiskStudy, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<double> one = all_studies(1);
  for (const std::size_t threads : {2U, 4U}) {
    EXPECT_EQ(all_studies(threads), one);
  }
}

}  // namespace
}  // namespace gonio

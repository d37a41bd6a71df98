#include "emulator/quality/batch_summary.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <numbers>

#include "emulator/uncertainty/random.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/quality/normal_batch.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using enum ConformanceVerdict;
using test::batch_of;
using test::is_close;
using test::panel_of;
using test::uncertainties_of;

/// Of numbers with few digits.
constexpr double last_bits = 1e-12;

/// A batch with all that a summary needs.
struct Bench {
  explicit Bench(Batch of) : batch(std::move(of)) {}

  Batch batch;
  ReadingUncertainties uncertainties = uncertainties_of(batch);
  PanelJudge judge{batch, uncertainties};
  BatchSummary summary{batch, judge};

  void add(PanelRecord panel) {
    judge.judge(panel);
    summary.add(panel);
  }
};

// The verdict of the batch.

struct VerdictRow {
  std::uint64_t accepted, refused, inconclusive;
  double share;
  ConformanceVerdict verdict;
};

TEST(BatchVerdict, CountsWhatIsAcceptedAndWhatMayStillBe) {
  for (const VerdictRow& row : {
           VerdictRow{1, 0, 0, 1.0, pass},
           VerdictRow{0, 1, 0, 1.0, fail},
           VerdictRow{0, 0, 1, 1.0, inconclusive},
           VerdictRow{1, 1, 0, 1.0, fail},
           VerdictRow{1, 0, 1, 1.0, inconclusive},
           VerdictRow{0, 1, 1, 1.0, fail},
           VerdictRow{1, 1, 1, 1.0, fail},
           VerdictRow{0, 0, 0, 1.0, not_applicable},
           // Half of them is enough.
           VerdictRow{1, 1, 0, 0.5, pass},
           VerdictRow{1, 0, 1, 0.5, pass},
           VerdictRow{0, 1, 1, 0.5, inconclusive},
           VerdictRow{1, 1, 1, 0.5, inconclusive},
           VerdictRow{1, 2, 1, 0.5, inconclusive},
           VerdictRow{1, 3, 0, 0.5, fail},
           VerdictRow{0, 2, 1, 0.5, fail},
           // A share that no double holds.
           VerdictRow{19, 1, 0, 0.95, pass},
           VerdictRow{18, 1, 1, 0.95, inconclusive},
           VerdictRow{18, 2, 0, 0.95, fail},
           VerdictRow{9, 1, 0, 0.9, pass},
       }) {
    EXPECT_EQ(batch_verdict(row.accepted, row.refused, row.inconclusive, row.share), row.verdict)
        << row.accepted << " accepted, " << row.refused << " refused, " << row.inconclusive
        << " inconclusive, share " << row.share;
  }
}

TEST(BatchSummary, CountsPanelsAndLotsByTheirVerdicts) {
  Bench bench(batch_of({.low = 80.0, .high = 90.0}));
  bench.batch.decision = {.rule = DecisionRule::guarded};
  bench.uncertainties[0].expanded = 1.0;
  bench.batch.plan.accepted_lots = 0.3;
  bench.add(panel_of(1, 1, {85.0}));
  bench.add(panel_of(1, 2, {86.0}));
  bench.add(panel_of(2, 3, {85.0}));
  bench.add(panel_of(2, 4, {92.0}));
  bench.add(panel_of(3, 5, {89.5}));
  const QaResult result = bench.summary.result();
  EXPECT_EQ(result.panels, 5U);
  EXPECT_EQ(result.readings, 5U);
  EXPECT_EQ(result.panels_passed, 3U);
  EXPECT_EQ(result.panels_failed, 1U);
  EXPECT_EQ(result.panels_inconclusive, 1U);
  EXPECT_EQ(result.lots_accepted, 1U);
  EXPECT_EQ(result.lots_refused, 1U);
  EXPECT_EQ(result.lots_inconclusive, 1U);
  EXPECT_EQ(result.verdict, pass);
  ASSERT_EQ(result.channels.size(), 1U);
  EXPECT_EQ(result.channels[0].passed, 3U);
  EXPECT_EQ(result.channels[0].failed, 1U);
  EXPECT_EQ(result.channels[0].inconclusive, 1U);
  EXPECT_EQ(result.channels[0].expanded_uncertainty, 1.0);
  ASSERT_EQ(result.lots.size(), 3U);
  EXPECT_EQ(result.lots[1].number, 2U);
  EXPECT_EQ(result.lots[1].nonconforming, 1U);
  EXPECT_EQ(result.acceptance, acceptance_words(bench.batch));
  EXPECT_EQ(result.decision, decision_words(bench.batch));
}

TEST(BatchSummary, SaysNothingOfABatchWithoutPanels) {
  const Bench bench(batch_of({.low = 80.0}));
  const QaResult result = bench.summary.result();
  EXPECT_EQ(result.verdict, not_applicable);
  EXPECT_EQ(result.panels, 0U);
  EXPECT_TRUE(result.lots.empty());
  ASSERT_EQ(result.channels.size(), 1U);
  EXPECT_FALSE(result.channels[0].capability);
}

TEST(BatchSummary, ListsTheFirstHundredLotsAndCountsAll) {
  Bench bench(batch_of({.low = 80.0}));
  for (std::uint64_t lot = 1; lot <= 250; ++lot) {
    bench.add(panel_of(lot, lot, {lot % 5 == 0 ? 70.0 : 85.0}));
  }
  const QaResult result = bench.summary.result();
  EXPECT_EQ(result.lots.size(), 100U);
  EXPECT_EQ(result.lots_accepted, 200U);
  EXPECT_EQ(result.lots_refused, 50U);
}

TEST(BatchSummary, MayBeAskedWhileALotIsOpen) {
  Bench bench(batch_of({.low = 80.0}));
  bench.add(panel_of(1, 1, {85.0}));
  EXPECT_EQ(bench.summary.result().lots_accepted, 1U);
  bench.add(panel_of(1, 2, {70.0}));
  const QaResult result = bench.summary.result();
  EXPECT_EQ(result.lots_accepted, 0U);
  EXPECT_EQ(result.lots_refused, 1U);
  EXPECT_EQ(result.lots.front().panels, 2U);
}

// Statistics of a channel.

// Worked by hand: panel means 10, 12, 11, 13, 14; moving ranges 2, 1, 2, 1, their mean 1.5.
TEST(BatchSummary, ComputesCapabilityFromThePanelMeans) {
  Bench bench(batch_of({.low = 6.0, .high = 20.0}));
  std::uint64_t number = 0;
  for (const double mean : {10.0, 12.0, 11.0, 13.0, 14.0}) {
    ++number;
    bench.add(panel_of(1, number, {mean - 0.5, mean + 0.5}));
  }
  const ChannelSummary channel = bench.summary.result().channels[0];
  const double within = 1.5 * std::sqrt(std::numbers::pi) / 2.0;
  const double overall = std::sqrt(2.5);
  EXPECT_TRUE(is_close(channel.mean, 12.0, last_bits));
  EXPECT_TRUE(is_close(channel.standard_deviation, overall, last_bits));
  EXPECT_EQ(channel.lowest, 10.0);
  EXPECT_EQ(channel.highest, 14.0);
  EXPECT_TRUE(is_close(channel.mean_range, 1.0, last_bits));
  EXPECT_EQ(channel.panels, 5U);
  EXPECT_EQ(channel.readings, 10U);
  ASSERT_TRUE(channel.capability && channel.capability->cpk && channel.capability->ppk);
  EXPECT_TRUE(is_close(channel.capability->cp->value, 14.0 / (6.0 * within), last_bits));
  EXPECT_TRUE(is_close(channel.capability->cpk->value, 6.0 / (3.0 * within), last_bits));
  EXPECT_TRUE(is_close(channel.capability->pp->value, 14.0 / (6.0 * overall), last_bits));
  EXPECT_TRUE(is_close(channel.capability->ppk->value, 6.0 / (3.0 * overall), last_bits));
  // The chart of single values has the same spread.
  EXPECT_TRUE(is_close(channel.charts.individual.sigma, within, last_bits));
}

// Two lots of two panels of two readings: sums of squares by hand.
TEST(BatchSummary, SplitsTheSpreadIntoLotsPanelsAndReadings) {
  Bench bench(batch_of({.low = 0.0}));
  bench.add(panel_of(1, 1, {9.0, 11.0}));
  bench.add(panel_of(1, 2, {13.0, 15.0}));
  bench.add(panel_of(2, 3, {29.0, 31.0}));
  bench.add(panel_of(2, 4, {33.0, 35.0}));
  const NestedSpread spread = bench.summary.result().channels[0].spread;
  // Readings: 4 times 2 over 4; panels: means 4 apart in a lot, 2 readings; lots: means 20 apart.
  const double readings = 2.0, of_panels = 16.0, of_lots = 800.0;
  EXPECT_TRUE(is_close(spread.sd_readings, std::sqrt(readings), last_bits));
  EXPECT_TRUE(is_close(spread.sd_panels, std::sqrt((of_panels - readings) / 2.0), last_bits));
  EXPECT_TRUE(is_close(spread.sd_lots, std::sqrt((of_lots - of_panels) / 4.0), last_bits));
}

TEST(BatchSummary, HasNoCapabilityWithoutLimitsOrWithOnePanel) {
  Bench without(batch_of({}));
  without.add(panel_of(1, 1, {85.0}));
  without.add(panel_of(1, 2, {86.0}));
  EXPECT_FALSE(without.summary.result().channels[0].capability);
  Bench one(batch_of({.low = 80.0}));
  one.add(panel_of(1, 1, {85.0}));
  EXPECT_FALSE(one.summary.result().channels[0].capability);
}

TEST(BatchSummary, CountsHowUniformPanelsAre) {
  Batch batch = batch_of({.low = 0.0});
  batch.standard.readings = ReadingRule{.count = {.at_least = 2}};
  batch.standard.readings->reject = ReadingRule::Reject{.range_at_least_gu = 10.0};
  Bench bench(batch);
  bench.add(panel_of(1, 1, {85.0, 86.0}));
  bench.add(panel_of(1, 2, {85.0, 96.0}));
  bench.add(panel_of(1, 3, {85.0}));
  const QaResult result = bench.summary.result();
  const std::array<std::uint64_t, 4> expected{1, 1, 0, 1};
  EXPECT_EQ(result.channels[0].uniformity, expected);
  EXPECT_EQ(result.panels_failed, 1U);
  EXPECT_EQ(result.panels_inconclusive, 1U);
  EXPECT_EQ(result.lots[0].not_uniform, 1U);
}

TEST(BatchSummary, SpeaksFirstOfTheChannelWithTheLowestCpk) {
  Batch batch = batch_of({.low = 0.0}, {"20", "60"});
  batch.requirements.push_back({.channel = 1, .limits = {.low = 84.0}});
  Bench bench(batch);
  for (std::uint64_t number = 1; number <= 4; ++number) {
    PanelRecord panel = panel_of(1, number, {50.0 + double(number % 2)});
    panel.readings.push_back({.channel = 1, .value = 85.0 + double(number % 2)});
    bench.add(panel);
  }
  EXPECT_EQ(bench.summary.result().main_channel, 1U);
}

TEST(BatchSummary, KeepsHazeAsOneValueOfEachPanel) {
  Batch batch = batch_of({.low = 0.0}, {"60", "20"});
  batch.standard.haze = {
      {.id = "haze", .from = "60", .minus = "20", .only_above = {}, .evidence = {}}};
  batch.channels.push_back(
      {.id = "haze", .geometry = {}, .kind = BatchChannel::Kind::haze, .unit = "GU"});
  Bench bench(batch);
  for (std::uint64_t number = 1; number <= 3; ++number) {
    PanelRecord panel = panel_of(1, number, {90.0, 92.0});
    panel.readings.push_back({.channel = 1, .value = 80.0 + double(number)});
    bench.add(panel);
  }
  const ChannelSummary haze = bench.summary.result().channels[2];
  EXPECT_EQ(haze.panels, 3U);
  EXPECT_EQ(haze.readings, 0U);
  EXPECT_TRUE(is_close(haze.mean, 9.0, last_bits));
  EXPECT_TRUE(is_close(haze.standard_deviation, 1.0, last_bits));
  EXPECT_FALSE(haze.charts.mean);
  EXPECT_EQ(haze.charts.individual.points, 3U);
  EXPECT_TRUE(haze.positions.empty());
}

TEST(BatchSummary, TellsOfPositionsWhereTheyAre) {
  Batch batch = batch_of({.low = 0.0});
  batch.plan.positions = {{.x_mm = 30.0, .y_mm = 50.0}, {.x_mm = 75.0, .y_mm = 50.0}};
  batch.plan.further_positions = {{.x_mm = 120.0, .y_mm = 20.0}};
  batch.product = Product{};
  batch.instruments[0].beam["60"] = {.in_plane_mm = 4.0, .perpendicular_mm = 6.0};
  Bench bench(batch);
  bench.add(panel_of(1, 1, {80.0, 81.0, 82.0, 83.0}));
  bench.add(panel_of(1, 2, {84.0, 83.0}));
  const std::vector<PositionSummary> positions = bench.summary.result().channels[0].positions;
  ASSERT_EQ(positions.size(), 4U);
  EXPECT_EQ(positions[0].position, 1U);
  EXPECT_EQ(positions[0].readings, 2U);
  EXPECT_TRUE(is_close(positions[0].mean, 82.0, last_bits));
  EXPECT_TRUE(is_close(positions[0].standard_deviation, std::sqrt(8.0), last_bits));
  EXPECT_EQ(positions[1].x_mm, 75.0);
  EXPECT_EQ(positions[2].x_mm, 120.0);
  EXPECT_EQ(positions[2].y_mm, 20.0);
  EXPECT_FALSE(positions[3].x_mm);
  // Twice as long at 60 deg.
  EXPECT_TRUE(is_close(positions[0].half_length_mm.value(), 4.0, last_bits));
  EXPECT_EQ(positions[0].half_width_mm, 3.0);
  EXPECT_FALSE(positions[3].half_length_mm);
}

TEST(BatchSummary, DoesNotKnowWhereOnPanelsItIsWithoutAProduct) {
  Bench bench(batch_of({.low = 0.0}));
  bench.add(panel_of(1, 1, {80.0}));
  const QaResult result = bench.summary.result();
  EXPECT_FALSE(result.channels[0].positions.at(0).x_mm);
  EXPECT_FALSE(result.channels[0].positions[0].half_length_mm);
  EXPECT_EQ(result.panel_length_mm, 0.0);
}

// The spread between neighbours.

TEST(MovingSpread, IsAsSureAsOneDifferenceForTwoValues) {
  MovingSpread spread;
  EXPECT_EQ(spread.result().value, 0.0);
  spread.add(3.0);
  EXPECT_EQ(spread.result().value, 0.0);
  spread.add(5.0);
  EXPECT_TRUE(is_close(spread.result().value, std::sqrt(std::numbers::pi), last_bits));
  // |x| of a normal x: mean^2 = 2 / pi, variance 1 - 2 / pi, and nu = mean^2 / (2 variance).
  EXPECT_TRUE(
      is_close(spread.result().degrees_of_freedom, 1.0 / (std::numbers::pi - 2.0), last_bits));
}

// Whatever follows from the formula shows in samples too.
TEST(MovingSpread, HasTheDegreesOfFreedomThatItsScatterShows) {
  constexpr std::uint64_t seed = 20260701;
  constexpr std::size_t values = 12;
  const std::size_t samples = test::trials(40000);
  // Of a variance from so many samples of nearly normal shape, five times over.
  const double tolerance = 5.0 * std::sqrt(2.0 / double(samples));
  RunningStatistics spreads;
  double freedom = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    std::array<double, values> normal{};
    Draws(seed, i).normal(normal);
    MovingSpread spread;
    for (const double value : normal) {
      spread.add(value);
    }
    spreads.add(spread.result().value);
    freedom = spread.result().degrees_of_freedom;
  }
  const double sd = spreads.result().standard_deviation;
  EXPECT_TRUE(test::is_close_relative(1.0 / (2.0 * sd * sd), freedom, tolerance));
  EXPECT_TRUE(is_close(spreads.result().mean, 1.0, 5.0 * sd / std::sqrt(double(samples))));
}

// Gauge studies.

/// A part read by two appraisers, twice each.
PanelRecord part(std::uint64_t number, const std::array<double, 4>& values) {
  PanelRecord panel{.study = PanelRecord::Study::gauge, .number = number};
  for (std::uint32_t i = 0; i < 4; ++i) {
    panel.readings.push_back({.repetition = i % 2 + 1, .operator_ = i / 2, .value = values[i]});
  }
  return panel;
}

TEST(BatchSummary, StudiesTheGaugeByItsOwnPanelsOnly) {
  Batch batch = batch_of({.low = 0.0, .high = 60.0});
  batch.operators.push_back({.id = "ben"});
  Bench bench(batch);
  bench.add(panel_of(1, 1, {85.0}));
  bench.summary.add(part(1, {10.0, 11.0, 12.0, 12.0}));
  bench.summary.add(part(2, {20.0, 21.0, 21.0, 23.0}));
  bench.summary.add(part(3, {30.0, 30.0, 33.0, 32.0}));
  const QaResult result = bench.summary.result();
  EXPECT_EQ(result.panels, 1U);
  ASSERT_EQ(result.gauge.size(), 1U);
  const ChannelGauge& gauge = result.gauge[0];
  EXPECT_EQ(gauge.panels, 3U);
  EXPECT_EQ(gauge.repetitions, 2U);
  ASSERT_EQ(gauge.appraisers.size(), 2U);
  EXPECT_EQ(gauge.appraisers[1], bench.batch.instruments[0].id + ", ben");
  const GaugeStudy direct =
      gauge_study({.parts = 3,
                   .appraisers = 2,
                   .repetitions = 2,
                   .values = {10, 11, 12, 12, 20, 21, 21, 23, 30, 30, 33, 32}},
                  60.0);
  EXPECT_EQ(gauge.study.sd_gauge, direct.sd_gauge);
  EXPECT_EQ(gauge.study.sd_part, direct.sd_part);
  EXPECT_EQ(gauge.study.percent_of_tolerance, direct.percent_of_tolerance);
}

TEST(BatchSummary, LeavesOutOfAGaugeStudyWhatNotAllHaveRead) {
  Batch batch = batch_of({});
  batch.operators.push_back({.id = "ben"});
  Bench bench(batch);
  bench.summary.add(part(1, {10.0, 11.0, 12.0, 12.0}));
  PanelRecord by_one = part(2, {90.0, 21.0, 0.0, 0.0});
  by_one.readings.resize(2);
  bench.summary.add(by_one);
  EXPECT_TRUE(bench.summary.result().gauge.empty());
  bench.summary.add(part(3, {30.0, 30.0, 33.0, 32.0}));
  const QaResult result = bench.summary.result();
  ASSERT_EQ(result.gauge.size(), 1U);
  EXPECT_EQ(result.gauge[0].panels, 2U);
  EXPECT_FALSE(result.gauge[0].study.percent_of_tolerance);
}

// Memory.

TEST(BatchSummary, NeedsNoMoreMemoryForAMillionPanels) {
  const std::size_t panels = test::trials(1000000);
  // What control charts still put on until their baseline is complete has come long before.
  const std::size_t early = panels / 100;
  constexpr std::size_t slack_bytes = 16384;  // buffers of the charts and bins that join and split
  Bench bench(batch_of({.low = 80.0, .high = 90.0}));
  PanelRecord panel = panel_of(1, 1, {85.0, 85.0});
  bench.judge.judge(panel);
  std::size_t bytes_early = 0;
  for (std::size_t i = 0; i < panels; ++i) {
    panel.number = i + 1;
    panel.lot = i / 10 + 1;
    panel.channels[0].mean = 85.0 + std::sin(double(i));
    panel.readings[1].position = std::uint32_t(i + 1);
    bench.summary.add(panel);
    if (i == early) {
      bytes_early = ::mallinfo2().uordblks;
    }
  }
  EXPECT_LE(::mallinfo2().uordblks, bytes_early + slack_bytes);
  EXPECT_EQ(bench.summary.result().panels, panels);
}

}  // namespace
}  // namespace gonio

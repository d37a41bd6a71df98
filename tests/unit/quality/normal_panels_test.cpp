#include "emulator/quality/normal_panels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "emulator/quality/batch_summary.hpp"
#include "emulator/quality/lot_study.hpp"
#include "emulator/statistics/sampling_plan.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/quality/normal_batch.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::batch_of;
using test::is_close;
using test::uncertainties_of;

/// What five standard deviations hold: chance leaves them once in two million times.
constexpr double five = 5.0;
constexpr double last_bits = 1e-12;

TEST(NormalPanels, ScatterAboutTheirTruthAsTheyAreRead) {
  Batch batch = batch_of({});
  batch.plan.panels = 1;
  batch.plan.repetitions = 4;
  const ReadingUncertainties uncertainties = uncertainties_of(batch, {.systematic = 0.3});
  const NormalPanels panels(batch, uncertainties, {{{.mean = 85.0, .sd_readings = 0.8}}});
  const std::size_t n = test::trials(20000);
  Moments errors;
  for (std::size_t i = 1; i <= n; ++i) {
    const ChannelResult result = panels.inspect(i).channels.at(0);
    errors.add(result.mean - result.truth.value());
  }
  const double sd = std::hypot(0.3, 0.4);
  EXPECT_TRUE(is_close(errors.mean(), 0.0, five * sd / std::sqrt(double(n))));
  EXPECT_TRUE(is_close(errors.standard_deviation(), sd, five * sd / std::sqrt(2.0 * double(n))));
}

TEST(NormalPanels, OfALotHaveTheTruthOfTheLot) {
  Batch batch = batch_of({.low = 84.0, .high = 88.0});
  batch.plan.panels = test::trials(20000);
  const ReadingUncertainties uncertainties = uncertainties_of(batch, {.systematic = 5.0});
  const NormalPanels panels(batch, uncertainties,
                            {{{.mean = 85.0, .sd_lots = 1.0, .sd_panels = 1.5}}});
  const LotTruth lot = panels.truth(3);
  Moments truths;
  double beyond = 0.0;
  for (std::uint64_t i = 1; i <= batch.plan.panels; ++i) {
    const PanelRecord panel = panels.inspect(2 * batch.plan.panels + i);
    ASSERT_EQ(panel.lot, 3U);
    const double truth = panel.channels.at(0).truth.value();
    truths.add(truth);
    beyond += truth < 84.0 || truth > 88.0 ? 1.0 : 0.0;
  }
  const double n = double(batch.plan.panels), p = lot.beyond.at(0);
  EXPECT_NE(lot.mean.at(0), 85.0);
  EXPECT_EQ(lot.sd.at(0), 1.5);
  EXPECT_EQ(p, beyond_limits(lot.mean.at(0), 1.5, {.low = 84.0, .high = 88.0}));
  EXPECT_TRUE(is_close(truths.mean(), lot.mean[0], five * 1.5 / std::sqrt(n)));
  EXPECT_TRUE(is_close(beyond / n, p, five * std::sqrt(p * (1.0 - p) / n)));
}

TEST(NormalPanels, ShareTheErrorOfTheirInstrumentInALotAndNoOther) {
  Batch batch = batch_of({});
  batch.plan.panels = 4;
  batch.instruments.push_back(batch.instruments.front());
  const ReadingUncertainties uncertainties = uncertainties_of(batch, {.systematic = 1.0});
  const NormalPanels panels(batch, uncertainties, {{{.mean = 85.0, .sd_panels = 1.0}}});
  const auto error = [&](std::uint64_t number) {
    const PanelRecord panel = panels.inspect(number);
    return panel.channels.at(0).mean - panel.channels[0].truth.value();
  };
  constexpr double of_the_sum = 1e-12;  // of an error and a truth of 85
  EXPECT_TRUE(is_close(error(1), error(3), of_the_sum));
  EXPECT_TRUE(is_close(error(2), error(4), of_the_sum));
  EXPECT_GT(std::abs(error(1) - error(2)), 1e-3);
  EXPECT_GT(std::abs(error(1) - error(5)), 1e-3);
}

TEST(NormalPanels, AreReadByAppraisersInTurn) {
  Batch batch = batch_of({});
  batch.instruments.push_back(batch.instruments.front());
  batch.operators.push_back({.id = "ben"});
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalPanels panels(batch, uncertainties, {{{.mean = 85.0}}});
  for (std::uint64_t number = 1; number <= 8; ++number) {
    const ReadingRecord reading = panels.inspect(number).readings.at(0);
    EXPECT_EQ(reading.instrument, (number - 1) % 4 / 2);
    EXPECT_EQ(reading.operator_, (number - 1) % 2);
  }
}

TEST(NormalPanels, DependOnTheirNumberAndTheSeedAlone) {
  Batch batch = batch_of({});
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalProduct product{{{.mean = 85.0, .sd_lots = 1.0, .sd_panels = 1.0}}};
  const NormalPanels panels(batch, uncertainties, product);
  const PanelRecord seventh = panels.inspect(7);
  EXPECT_NE(panels.inspect(8).readings, seventh.readings);
  EXPECT_EQ(panels.inspect(7), seventh);
  EXPECT_EQ(NormalPanels(batch, uncertainties, product).inspect(7), seventh);
  Batch other = batch;
  other.seed = 2;
  EXPECT_NE(NormalPanels(other, uncertainties, product).inspect(7), seventh);
}

// With more repetitions the draws of the first stay what they were.
TEST(NormalPanels, KeepTheirTruthHoweverOftenTheyAreRead) {
  Batch batch = batch_of({});
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalProduct product{{{.mean = 85.0, .sd_panels = 1.0, .sd_readings = 1.0}}};
  const PanelRecord once = NormalPanels(batch, uncertainties, product).inspect(3);
  batch.plan.repetitions = 5;
  const PanelRecord more = NormalPanels(batch, uncertainties, product).inspect(3);
  EXPECT_EQ(more.channels[0].truth, once.channels[0].truth);
  EXPECT_EQ(more.readings.size(), 5U);
  EXPECT_EQ(more.readings[0], once.readings[0]);
}

TEST(NormalPanels, AreReadAtFurtherPositionsWhereTheRuleAsks) {
  Batch batch = batch_of({.low = 0.0});
  batch.plan.repetitions = 2;
  batch.plan.further_positions = {{.x_mm = 60.0, .y_mm = 50.0}, {.x_mm = 90.0, .y_mm = 50.0}};
  batch.standard.readings = ReadingRule{.count = {.at_least = 2}};
  batch.standard.readings->more = ReadingRule::More{.when_range_above_gu = 1.0, .count = 4};
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalPanels panels(batch, uncertainties, {{{.mean = 85.0, .sd_readings = 1.0}}});
  std::size_t extended = 0;
  for (std::uint64_t number = 1; number <= 100; ++number) {
    const PanelRecord panel = panels.inspect(number);
    const double range = std::abs(panel.readings[0].value - panel.readings[1].value);
    EXPECT_EQ(panel.readings.size(), range > 1.0 ? 6U : 2U);
    EXPECT_EQ(panel.channels[0].n, panel.readings.size());
    if (panel.readings.size() == 6) {
      ++extended;
      EXPECT_EQ(panel.readings[2].position, 2U);
      EXPECT_EQ(panel.readings[5].position, 3U);
      EXPECT_EQ(panel.readings[5].repetition, 2U);
    }
  }
  EXPECT_GT(extended, 0U);
  EXPECT_LT(extended, 100U);
}

TEST(NormalPanels, HaveTheHazeOfTheirGeometries) {
  Batch batch = batch_of({}, {"60", "20"});
  batch.standard.haze = {
      {.id = "haze", .from = "60", .minus = "20", .only_above = 85.0, .evidence = {}}};
  batch.channels.push_back(
      {.id = "haze", .geometry = {}, .kind = BatchChannel::Kind::haze, .unit = "GU"});
  batch.requirements = {{.channel = 2, .limits = {.high = 10.0}}};
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalProduct product{{{.mean = 90.0, .sd_lots = 1.0, .sd_panels = 0.3},
                               {.mean = 80.0, .sd_lots = 1.0, .sd_panels = 0.4},
                               {}}};
  const NormalPanels panels(batch, uncertainties, product);
  const LotTruth lot = panels.truth(1);
  EXPECT_EQ(lot.mean[2], lot.mean[0] - lot.mean[1]);
  EXPECT_TRUE(is_close(lot.sd[2], 0.5, last_bits));
  EXPECT_EQ(lot.beyond[2], beyond_limits(lot.mean[2], lot.sd[2], {.high = 10.0}));
  const PanelRecord panel = panels.inspect(1);
  EXPECT_EQ(panel.channels.at(2).truth.value(),
            panel.channels[0].truth.value() - panel.channels[1].truth.value());
  EXPECT_FALSE(panels.normal_components(2));
  EXPECT_EQ(panels.normal_components(1)->mean, 80.0);
  // Where the standard does not define it, it has no truth.
  NormalProduct dull = product;
  dull.channels[0].mean = 70.0;
  const NormalPanels of_dull(batch, uncertainties, dull);
  EXPECT_EQ(of_dull.inspect(1).channels.size(), 2U);
  EXPECT_TRUE(std::isnan(of_dull.truth(1).mean[2]));
  EXPECT_EQ(of_dull.truth(1).beyond[2], 0.0);
}

TEST(NormalPanels, RefuseAProductOfOtherChannels) {
  const Batch batch = batch_of({});
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  EXPECT_EQ(test::message_of([&] {
              NormalPanels(batch, uncertainties, {{{}, {}}});
            }),
            "NormalPanels: expected 1 channels, found 2");
}

// There and back: a product, its panels, their summary, the product that fits it.
TEST(NormalProduct, IsFoundAgainFromItsReadings) {
  Batch batch = batch_of({.low = 80.0});
  batch.plan.panels = 10;
  batch.plan.repetitions = 3;
  const std::uint64_t lots = test::trials(2000);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalComponents made{.mean = 85.0, .sd_lots = 1.0, .sd_panels = 0.5, .sd_readings = 0.25};
  const NormalPanels panels(batch, uncertainties, {{made}});
  const PanelJudge judge(batch, uncertainties);
  BatchSummary summary(batch, judge);
  for (std::uint64_t number = 1; number <= lots * batch.plan.panels; ++number) {
    summary.add(panels.inspect(number));
  }
  const NormalComponents found = normal_product(summary.result()).channels.at(0);
  const auto is_found = [&](double got, double expected, double freedom) {
    return test::is_close_relative(got, expected, five / std::sqrt(2.0 * freedom));
  };
  const double n = double(lots);
  EXPECT_TRUE(is_close(found.mean, 85.0, five / std::sqrt(n)));
  EXPECT_TRUE(is_found(found.sd_lots, 1.0, 0.9 * n));  // a tenth is what panels add to their mean
  EXPECT_TRUE(is_found(found.sd_panels, 0.5, 7.0 * n));
  EXPECT_TRUE(is_found(found.sd_readings, 0.25, 20.0 * n));
}

}  // namespace
}  // namespace gonio

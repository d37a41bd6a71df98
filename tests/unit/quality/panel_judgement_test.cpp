#include "emulator/quality/panel_judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/quality/made_batch.hpp"

namespace gonio {

namespace {

using enum ConformanceVerdict;
using test::made_batch;
using test::read_panel;
using test::same_uncertainty;

const ChannelResult& result_of(const PanelRecord& panel, std::uint32_t channel) {
  return panel.channels.at(channel);
}

PanelRecord judged(const Batch& batch, double U, PanelRecord panel) {
  const ReadingUncertainties uncertainties = same_uncertainty(batch, U);
  PanelJudge(batch, uncertainties).judge(panel);
  return panel;
}

Batch batch_60(double low, double high) {
  Batch batch = made_batch({"60"});
  batch.requirements = {{.channel = 0, .limits = {.low = low, .high = high}}};
  return batch;
}

}  // namespace

TEST(PanelJudge, TellsMeanRangeAndSpreadOfEachChannel) {
  const PanelRecord panel =
      judged(made_batch({"20", "60"}), 0.0, read_panel({{10.0, 11.0, 12.0}, {50.0, 50.5, 52.0}}));
  EXPECT_EQ(result_of(panel, 0).n, 3U);
  EXPECT_DOUBLE_EQ(result_of(panel, 0).mean, 11.0);
  EXPECT_DOUBLE_EQ(result_of(panel, 0).standard_deviation, 1.0);
  EXPECT_DOUBLE_EQ(result_of(panel, 1).range, 2.0);
  EXPECT_EQ(panel.verdict, not_applicable) << "there are no limits";
}

TEST(PanelJudge, PassesOnlyByMoreThanUWithAGuardBand) {
  Batch batch = batch_60(82.0, 88.0);
  const auto verdict = [&](double mean, double U) {
    return judged(batch, U, read_panel({{mean, mean, mean}})).verdict;
  };
  EXPECT_EQ(verdict(87.5, 1.0), pass) << "simple";
  batch.decision.rule = DecisionRule::guarded;
  EXPECT_EQ(verdict(87.5, 1.0), inconclusive);
  EXPECT_EQ(verdict(87.0, 1.0), pass);
  EXPECT_EQ(verdict(88.5, 1.0), inconclusive);
  EXPECT_EQ(verdict(89.5, 1.0), fail);
  batch.decision.guard_band_factor = 0.25;
  EXPECT_EQ(verdict(87.5, 1.0), pass);
}

TEST(PanelJudge, FailsAPanelThatTheReadingRuleRejects) {
  const PanelRecord panel = judged(batch_60(0.0, 100.0), 0.0, read_panel({{80.0, 85.0, 90.0}}));
  EXPECT_EQ(result_of(panel, 0).uniformity, PanelVerdict::rejected);
  EXPECT_EQ(panel.verdict, fail);
}

TEST(PanelJudge, DoesNotPassAPanelThatWantsMoreReadings) {
  const Batch batch = batch_60(82.0, 88.0);
  EXPECT_EQ(judged(batch, 0.0, read_panel({{85.0, 85.0}})).verdict, inconclusive);
  EXPECT_EQ(judged(batch, 0.0, read_panel({{90.0, 90.0}})).verdict, fail);
}

TEST(PanelJudge, SaysHowManyReadingsAreWanting) {
  const Batch batch = made_batch({"60"});
  const ReadingUncertainties uncertainties = same_uncertainty(batch, 0.0);
  const PanelJudge judge(batch, uncertainties);
  PanelRecord few = read_panel({{50.0}});
  PanelRecord wide = read_panel({{50.0, 53.0, 56.0}});
  PanelRecord enough = read_panel({{50.0, 51.0, 52.0}});
  EXPECT_EQ(judge.judge(few), 2U);
  EXPECT_EQ(judge.judge(wide), 3U);
  EXPECT_EQ(judge.judge(enough), 0U);
}

TEST(PanelJudge, AsksOnlyForTheGeometryThatTheStandardSelects) {
  Batch batch = made_batch({"20", "60", "85"});
  batch.selected_only = true;
  batch.requirements = {{.channel = 0, .limits = {.low = 50.0}},
                        {.channel = 1, .limits = {.low = 40.0}},
                        {.channel = 2, .limits = {.high = 5.0}}};
  const auto at = [&](double g20, double g60, double g85) {
    return judged(batch, 0.0, read_panel({{g20, g20, g20}, {g60, g60, g60}, {g85, g85, g85}}));
  };
  // 60 deg above 70 GU: 20 deg decides; below 10 GU: 85 deg; else 60 deg itself.
  EXPECT_EQ(at(45.0, 80.0, 50.0).verdict, fail);
  EXPECT_EQ(at(55.0, 80.0, 50.0).verdict, pass);
  EXPECT_EQ(at(0.0, 45.0, 50.0).verdict, pass);
  EXPECT_EQ(at(0.0, 5.0, 4.0).verdict, pass);
  EXPECT_EQ(at(0.0, 5.0, 6.0).verdict, fail);
  EXPECT_EQ(result_of(at(0.0, 45.0, 50.0), 2).verdict, not_applicable);
}

TEST(PanelJudge, RefusesAPanelWithoutAReadingOfAChannel) {
  const Batch batch = made_batch({"20", "60"});
  EXPECT_THROW(judged(batch, 0.0, read_panel({{50.0, 50.0, 50.0}})), std::invalid_argument);
}

TEST(PanelJudge, TakesTheUOfTheInstrumentThatRead) {
  Batch batch = batch_60(82.0, 88.0);
  batch.decision.rule = DecisionRule::guarded;
  batch.instruments.push_back(batch.instruments.front());
  const ReadingUncertainties uncertainties{{.expanded = 0.1}, {.expanded = 2.0}};
  const PanelJudge judge(batch, uncertainties);
  PanelRecord panel = read_panel({{87.0, 87.0, 87.0}});
  judge.judge(panel);
  EXPECT_EQ(panel.verdict, pass);
  for (ReadingRecord& reading : panel.readings) {
    reading.instrument = 1;
  }
  judge.judge(panel);
  EXPECT_EQ(panel.verdict, inconclusive);
  EXPECT_EQ(judge.expanded_uncertainty(0), 2.0);
}

/// Panels of one reading rule and one geometry with these means.
LotSummary lot_of(const Batch& batch, double U, const std::vector<double>& means) {
  const ReadingUncertainties uncertainties = same_uncertainty(batch, U);
  const PanelJudge judge(batch, uncertainties);
  LotJudge lot(batch, judge);
  for (const double mean : means) {
    PanelRecord panel = read_panel({{mean, mean, mean}});
    judge.judge(panel);
    lot.add(panel);
  }
  return lot.result();
}

TEST(LotJudge, CountsPanelsThatDoNotConform) {
  Batch batch = batch_60(82.0, 88.0);
  EXPECT_EQ(lot_of(batch, 0.0, {83.0, 85.0, 87.0}).verdict, pass);
  EXPECT_EQ(lot_of(batch, 0.0, {83.0, 85.0, 89.0}).verdict, fail);
  batch.plan.accept.nonconforming = 1;
  EXPECT_EQ(lot_of(batch, 0.0, {83.0, 85.0, 89.0}).verdict, pass);
  EXPECT_EQ(lot_of(batch, 0.0, {81.0, 85.0, 89.0}).verdict, fail);
  batch.decision.rule = DecisionRule::guarded;
  EXPECT_EQ(lot_of(batch, 1.0, {82.5, 85.0, 85.0}).verdict, pass) << "one may fail";
  EXPECT_EQ(lot_of(batch, 1.0, {82.5, 85.0, 87.5}).verdict, inconclusive);
}

TEST(LotJudge, JudgesTheMeanOfPanels) {
  Batch batch = batch_60(82.0, 88.0);
  batch.plan.accept = {.kind = AcceptanceRule::Kind::mean};
  EXPECT_EQ(lot_of(batch, 0.0, {80.0, 90.0}).verdict, pass);
  EXPECT_EQ(lot_of(batch, 0.0, {88.0, 90.0}).verdict, fail);
  EXPECT_DOUBLE_EQ(lot_of(batch, 0.0, {80.0, 90.0}).mean.at(0), 85.0);
  EXPECT_EQ(lot_of(batch, 0.0, {80.0, 90.0}).nonconforming, 2U);
}

// Means of 84, 86: standard deviation sqrt(2); 85 is 3 from either limit, k = 3 / sqrt(2) = 2.12.
TEST(LotJudge, KeepsKStandardDeviationsFromTheLimits) {
  Batch batch = batch_60(82.0, 88.0);
  batch.plan.accept = {.kind = AcceptanceRule::Kind::variables, .k = 2.12};
  EXPECT_EQ(lot_of(batch, 0.0, {84.0, 86.0}).verdict, pass);
  batch.plan.accept.k = 2.13;
  EXPECT_EQ(lot_of(batch, 0.0, {84.0, 86.0}).verdict, fail);
}

TEST(LotJudge, BeginsAnewAfterEachLot) {
  const Batch batch = batch_60(82.0, 88.0);
  const ReadingUncertainties uncertainties = same_uncertainty(batch, 0.0);
  const PanelJudge judge(batch, uncertainties);
  LotJudge lot(batch, judge);
  for (const std::uint64_t number : {1U, 2U}) {
    PanelRecord panel = read_panel({{80.0 + 5.0 * double(number - 1), 80.0, 80.0}}, number, number);
    judge.judge(panel);
    lot.add(panel);
    const LotSummary summary = lot.result();
    EXPECT_EQ(summary.number, number);
    EXPECT_EQ(summary.panels, 1U);
    EXPECT_EQ(summary.nonconforming, 1U);
  }
}

TEST(LotJudge, HasNoMeanOfAChannelThatNobodyHas) {
  const Batch batch = made_batch({"60"});
  EXPECT_TRUE(std::isnan(lot_of(batch, 0.0, {}).mean.at(0)));
}

}  // namespace gonio

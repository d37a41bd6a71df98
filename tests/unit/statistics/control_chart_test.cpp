#include "emulator/statistics/control_chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double rounding = 1e-12;

using Five = std::array<double, 5>;

void add_to(ControlCharts& charts, const Five& values) {
  double sum = 0.0;
  std::for_each(values.begin(), values.end(), [&](double x) { sum += x; });
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  charts.add(values.size(), sum / double(values.size()), *high - *low);
}

// Montgomery, Introduction to Statistical Quality Control, tables 6.1 (the first 25) and 6.2: flow
// widths of the hard-bake process, micrometres.
const std::vector<Five> flow_widths = {
    {1.3235, 1.4128, 1.6744, 1.4573, 1.6914}, {1.4314, 1.3592, 1.6075, 1.4666, 1.6109},  //
    {1.4284, 1.4871, 1.4932, 1.4324, 1.5674}, {1.5028, 1.6352, 1.3841, 1.2831, 1.5507},  //
    {1.5604, 1.2735, 1.5265, 1.4363, 1.6441}, {1.5955, 1.5451, 1.3574, 1.3281, 1.4198},  //
    {1.6274, 1.5064, 1.8366, 1.4177, 1.5144}, {1.4190, 1.4303, 1.6637, 1.6067, 1.5519},  //
    {1.3884, 1.7277, 1.5355, 1.5176, 1.3688}, {1.4039, 1.6697, 1.5089, 1.4627, 1.5220},  //
    {1.4158, 1.7667, 1.4278, 1.5928, 1.4181}, {1.5821, 1.3355, 1.5777, 1.3908, 1.7559},  //
    {1.2856, 1.4106, 1.4447, 1.6398, 1.1928}, {1.4951, 1.4036, 1.5893, 1.6458, 1.4969},  //
    {1.3589, 1.2863, 1.5996, 1.2497, 1.5471}, {1.5747, 1.5301, 1.5171, 1.1839, 1.8662},  //
    {1.3680, 1.7269, 1.3957, 1.5014, 1.4449}, {1.4163, 1.3864, 1.3057, 1.6210, 1.5573},  //
    {1.5796, 1.4185, 1.6541, 1.5116, 1.7247}, {1.7106, 1.4412, 1.2361, 1.3820, 1.7601},  //
    {1.4371, 1.5051, 1.3485, 1.5670, 1.4880}, {1.4738, 1.5936, 1.6583, 1.4973, 1.4720},  //
    {1.5917, 1.4333, 1.5551, 1.5295, 1.6866}, {1.6399, 1.5243, 1.5705, 1.5563, 1.5530},  //
    {1.5797, 1.3663, 1.6240, 1.3732, 1.6877}, {1.4483, 1.5458, 1.4538, 1.4303, 1.6206},  //
    {1.5435, 1.6899, 1.5830, 1.3358, 1.4187}, {1.5175, 1.3446, 1.4723, 1.6657, 1.6661},  //
    {1.5454, 1.1093, 1.4072, 1.5039, 1.5264}, {1.4418, 1.5059, 1.5124, 1.4620, 1.6263},  //
    {1.4301, 1.2725, 1.5945, 1.5397, 1.5252}, {1.4981, 1.4506, 1.6174, 1.5837, 1.4962},  //
    {1.3009, 1.5060, 1.6231, 1.5831, 1.6454}, {1.4132, 1.4603, 1.5808, 1.7111, 1.7313},  //
    {1.3817, 1.3135, 1.4953, 1.4894, 1.4596}, {1.5765, 1.7014, 1.4026, 1.2773, 1.4541},  //
    {1.4936, 1.4373, 1.5139, 1.4808, 1.5293}, {1.5729, 1.6738, 1.5048, 1.5651, 1.7473},  //
    {1.8089, 1.5513, 1.8250, 1.4389, 1.6558}, {1.6236, 1.5393, 1.6738, 1.8698, 1.5036},  //
    {1.4120, 1.7931, 1.7345, 1.6391, 1.7791}, {1.7372, 1.5663, 1.4910, 1.7809, 1.5504},  //
    {1.5971, 1.7394, 1.6832, 1.6677, 1.7974}, {1.4295, 1.6536, 1.9134, 1.7272, 1.4370},  //
    {1.6217, 1.8220, 1.7915, 1.6744, 1.9404},                                            //
};

std::vector<std::uint64_t> points_of(const ControlChart& chart, int rule) {
  std::vector<std::uint64_t> points;
  for (const ControlSignal& signal : chart.first_signals) {
    if (signal.rule == rule) {
      points.push_back(signal.point);
    }
  }
  return points;
}

// The book: grand mean 1.5056, mean range 0.32521, limits 1.31795 and 1.69325, and 0 and 0.68749,
// by A2 = 0.577 and D4 = 2.114, in three decimals.
TEST(ControlCharts, HaveTheLimitsOfMontgomery) {
  constexpr double printed = 0.00005, factor = 0.0006 * 0.32521;
  ControlCharts charts(25);
  std::for_each(flow_widths.begin(), flow_widths.begin() + 25,
                [&](const Five& values) { add_to(charts, values); });
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.subgroup_size, 5u);
  EXPECT_EQ(got.baseline, 25u);
  const ControlChart& mean = got.mean.value();
  const ControlChart& range = got.range.value();
  EXPECT_TRUE(is_close(mean.centre, 1.5056, printed));
  EXPECT_TRUE(is_close(range.centre, 0.32521, printed));
  EXPECT_TRUE(is_close(mean.lower, 1.31795, printed + factor));
  EXPECT_TRUE(is_close(mean.upper, 1.69325, printed + factor));
  EXPECT_EQ(range.lower, 0.0);
  EXPECT_TRUE(is_close(range.upper, 0.68749, printed + factor));
  // sigma of the process: 0.1398.
  EXPECT_TRUE(is_close(mean.sigma * std::sqrt(5.0), 0.1398, printed));
  EXPECT_TRUE(mean.in_control());
  EXPECT_TRUE(range.in_control());
}

// The book, of the 20 samples that follow: in control until sample 43; samples 43 and 45 are above
// the limit; the chart of ranges stays in control.
TEST(ControlCharts, FindWhatMontgomeryFindsInPhaseTwo) {
  ControlCharts charts(25);
  std::for_each(flow_widths.begin(), flow_widths.end(),
                [&](const Five& values) { add_to(charts, values); });
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.baseline, 25u);
  EXPECT_EQ(got.mean->points, 45u);
  EXPECT_EQ(points_of(*got.mean, 1), (std::vector<std::uint64_t>{43, 45}));
  EXPECT_EQ(got.mean->signals[0], 2u);
  EXPECT_FALSE(got.mean->in_control());
  EXPECT_TRUE(got.range->in_control());
}

// NIST/SEMATECH e-Handbook of Statistical Methods, 6.3.2.2: flow rates of ten batches.
TEST(ControlCharts, HaveTheIndividualsOfNist) {
  constexpr double printed = 0.00005;
  // The handbook divides by 1.128.
  constexpr double rounded_d2 = 3.0 * 1.8778 * (1.0 / 1.128 - 1.0 / 1.12838);
  ControlCharts charts;
  for (const double x : {49.6, 47.6, 49.9, 51.3, 47.8, 51.2, 52.6, 52.4, 53.6, 52.1}) {
    charts.add(1, x, 0.0);
  }
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.subgroup_size, 1u);
  EXPECT_FALSE(got.mean || got.range);
  EXPECT_TRUE(is_close(got.individual.centre, 50.81, printed));
  EXPECT_TRUE(is_close(got.moving_range.centre, 1.8778, printed));
  EXPECT_TRUE(is_close(got.individual.upper, 55.8041, printed + rounded_d2));
  EXPECT_TRUE(is_close(got.individual.lower, 45.8159, printed + rounded_d2));
  EXPECT_TRUE(got.individual.in_control());
  EXPECT_EQ(got.individual.points, 10u);
  EXPECT_EQ(got.moving_range.points, 9u);
  EXPECT_EQ(got.moving_range.shown.front().first, 2u);
  EXPECT_EQ(got.moving_range.shown.back().last, 10u);
}

// A baseline of pairs, whose means are at the centre and whose ranges tell this sigma of a mean.
ControlCharts with_sigma_of_means(double sigma) {
  const double of_two = control_chart_constants(2).d2;
  ControlCharts charts(4);
  for (int i = 0; i < 4; ++i) {
    charts.add(2, 10.0, sigma * std::sqrt(2.0) * of_two);
  }
  return charts;
}

// What follows begins at point 5, in sigma of a mean.
std::vector<std::uint64_t> points_after_baseline(int rule, const std::vector<double>& z) {
  ControlCharts charts = with_sigma_of_means(0.5);
  for (const double value : z) {
    charts.add(2, 10.0 + 0.5 * value, 0.0);
  }
  return points_of(*charts.result().mean, rule);
}

using Points = std::vector<std::uint64_t>;

TEST(ControlCharts, FindAPlantedShiftAtTheLastPointOfEachPattern) {
  EXPECT_EQ(points_after_baseline(1, {0.1, 0.1, -3.1, 0.1}), (Points{7}));
  EXPECT_EQ(points_after_baseline(2, {0.1, 2.1, 0.1, 2.1, 0.1}), (Points{8}));
  EXPECT_EQ(points_after_baseline(3, {-1.1, -1.1, 0.1, -1.1, -1.1, 0.1}), (Points{9}));
  EXPECT_EQ(points_after_baseline(4, {0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, -0.2}), (Points{12}));
  EXPECT_EQ(points_after_baseline(4, std::vector<double>(10, 0.2)), (Points{12, 13, 14}));
}

TEST(ControlCharts, TakeMovingRangesFromOneSubgroupToTheNext) {
  // The mean moving range is 1.25, its upper limit that times D4 of two: 4.083.
  const std::vector<double> means = {3.0, 4.0, 2.5, 2.5, 6.55, 2.4, 2.5};
  ControlCharts charts(3);
  std::for_each(means.begin(), means.end(), [&](double mean) { charts.add(1, mean, 0.0); });
  const ControlChart got = charts.result().moving_range;
  EXPECT_TRUE(is_close_relative(got.centre, 1.25, rounding));
  ASSERT_EQ(got.shown.size(), means.size() - 1);
  for (std::size_t i = 1; i < means.size(); ++i) {
    EXPECT_EQ(got.shown[i - 1].first, i + 1);
    EXPECT_EQ(got.shown[i - 1].mean, std::abs(means[i] - means[i - 1]));
  }
  const ControlChartConstants& two = control_chart_constants(2);
  EXPECT_TRUE(is_close_relative(got.upper, 1.25 * two.D4, rounding));
  EXPECT_TRUE(is_close_relative(got.sigma, 1.25 * two.d3 / two.d2, rounding));
  EXPECT_EQ(points_of(got, 1), (Points{6}));
}

TEST(ControlCharts, AskRule1AloneOfRanges) {
  ControlCharts charts = with_sigma_of_means(0.5);
  const ControlChart before = charts.result().range.value();
  for (int i = 0; i < 20; ++i) {
    charts.add(2, 10.0 + (i % 2 == 0 ? 0.1 : -0.1), 0.99 * before.upper);
  }
  EXPECT_TRUE(charts.result().range->in_control());
  charts.add(2, 10.0, 1.01 * before.upper);
  EXPECT_EQ(points_of(*charts.result().range, 1), (Points{25}));
  EXPECT_EQ(charts.result().range->first_signals.size(), 1u);
}

TEST(ControlCharts, JudgeASubgroupOfAnotherSizeByItsOwnLimits) {
  // Sigma of a mean of two is 0.5: of eight it is 0.25.
  ControlCharts charts = with_sigma_of_means(0.5);
  charts.add(2, 10.8, 0.1);
  charts.add(8, 9.2, 0.1 + control_chart_constants(8).d2 / std::sqrt(2.0));
  charts.add(1, 10.8, 0.0);
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.subgroup_size, 2u);
  EXPECT_EQ(points_of(*got.mean, 1), (Points{6}));
  EXPECT_EQ(got.mean->points, 7u);
  EXPECT_EQ(got.range->points, 6u);
  EXPECT_TRUE(is_close_relative(got.mean->upper, 11.5, rounding));
}

TEST(ControlCharts, TakeSigmaFromRangesOfAllSizes) {
  // 0.5 d2 of its size each: sigma is 0.5, whatever the sizes.
  ControlCharts charts(3);
  for (const std::size_t n : {4u, 9u, 4u}) {
    charts.add(n, 7.0, 0.5 * control_chart_constants(n).d2);
  }
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.subgroup_size, 4u);
  EXPECT_TRUE(is_close_relative(got.mean->sigma, 0.25, rounding));
  EXPECT_TRUE(is_close_relative(got.range->centre, 0.5 * control_chart_constants(4).d2, rounding));
  EXPECT_TRUE(is_close_relative(got.range->sigma, 0.5 * control_chart_constants(4).d3, rounding));
}

TEST(ControlCharts, WeighTheGrandMeanByValues) {
  ControlCharts charts(3);
  charts.add(2, 1.0, 1.0);
  charts.add(2, 2.0, 1.0);
  charts.add(4, 5.0, 1.0);
  EXPECT_TRUE(is_close_relative(charts.result().mean->centre, 26.0 / 8.0, rounding));
  EXPECT_TRUE(is_close_relative(charts.result().individual.centre, 8.0 / 3.0, rounding));
}

TEST(ControlCharts, UseWhatThereIsBelowTheBaseline) {
  ControlCharts waiting(100), complete(45);
  for (const Five& values : flow_widths) {
    add_to(waiting, values);
    add_to(complete, values);
  }
  const ControlCharts::Result few = waiting.result(), all = complete.result();
  EXPECT_EQ(few.baseline, 45u);
  EXPECT_EQ(few.mean->centre, all.mean->centre);
  EXPECT_EQ(few.mean->sigma, all.mean->sigma);
  EXPECT_EQ(few.mean->signals, all.mean->signals);
  EXPECT_EQ(few.mean->shown.size(), 45u);
  EXPECT_EQ(few.range->upper, all.range->upper);
  EXPECT_EQ(few.individual.upper, all.individual.upper);
}

TEST(ControlCharts, CanBeAskedBeforeThereIsAnything) {
  ControlCharts charts(2);
  EXPECT_EQ(charts.result().baseline, 0u);
  EXPECT_EQ(charts.result().individual.points, 0u);
  EXPECT_FALSE(charts.result().mean);
  charts.add(3, 80.0, 1.0);
  EXPECT_EQ(charts.result().individual.centre, 80.0);
  EXPECT_EQ(charts.result().individual.sigma, 0.0);
  EXPECT_GT(charts.result().mean->sigma, 0.0);
}

TEST(ControlCharts, AskNoRuleWithoutSpread) {
  ControlCharts charts(3);
  for (const double mean : {5.0, 5.0, 5.0, 9.0, -100.0}) {
    charts.add(4, mean, 0.0);
  }
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.mean->sigma, 0.0);
  EXPECT_EQ(got.individual.sigma, 0.0);
  EXPECT_TRUE(got.mean->in_control() && got.range->in_control());
  EXPECT_TRUE(got.individual.in_control() && got.moving_range.in_control());
  EXPECT_EQ(got.mean->points, 5u);
}

TEST(ControlCharts, OfLargeSubgroupsAreThoseOfMeans) {
  ControlCharts charts(3);
  for (const double mean : {5.0, 6.0, 5.0}) {
    charts.add(101, mean, 4.0);
  }
  const ControlCharts::Result got = charts.result();
  EXPECT_EQ(got.subgroup_size, 101u);
  EXPECT_FALSE(got.mean || got.range);
  EXPECT_GT(got.individual.sigma, 0.0);
}

// Seed 41; a million subgroups of five in control, limits of the first 20000. Sigma is known from
// these to 0.36 / sqrt(20000) of itself, which is worth ten times as much of the rate.
TEST(ControlCharts, GiveFalseAlarmsByRule1AsOftenAsNormalTailsSayAndStaySmall) {
  const std::size_t subgroups = test::trials(1000000), baseline = subgroups / 50;
  const double rate = std::erfc(3.0 / std::sqrt(2.0));
  const double chance = std::sqrt(rate / double(subgroups));
  const double of_sigma = 10.0 * rate * 0.36 / std::sqrt(double(baseline));
  std::mt19937_64 random(41);
  std::normal_distribution<double> normal(85.0, 1.5);
  ControlCharts charts(baseline);
  for (std::size_t i = 0; i < subgroups; ++i) {
    Five values;
    std::generate(values.begin(), values.end(), [&] { return normal(random); });
    add_to(charts, values);
  }
  const ControlChart got = charts.result().mean.value();
  EXPECT_TRUE(is_close(double(got.signals[0]) / double(subgroups), rate,
                       4.0 * std::hypot(chance, of_sigma)));
  EXPECT_EQ(got.points, subgroups);
  EXPECT_LE(got.shown.size(), 400u);
  EXPECT_EQ(got.shown.back().last, subgroups);
  EXPECT_EQ(got.first_signals.size(), 100u);
}

TEST(ControlCharts, RefuseWhatIsNoSubgroup) {
  EXPECT_EQ(test::message_of([] { ControlCharts(1); }),
            "ControlCharts: expected a baseline of two subgroups or more, found 1");
  ControlCharts charts(2);
  EXPECT_THROW(charts.add(0, 1.0, 0.0), std::domain_error);
  EXPECT_THROW(charts.add(2, std::numeric_limits<double>::quiet_NaN(), 0.0), std::domain_error);
  EXPECT_THROW(charts.add(2, 1.0, -1.0), std::domain_error);
  EXPECT_EQ(charts.result().individual.points, 0u);
}

}  // namespace
}  // namespace gonio

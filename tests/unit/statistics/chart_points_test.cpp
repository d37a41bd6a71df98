#include "emulator/statistics/chart_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

constexpr double rounding = 1e-12;

double value_at(std::uint64_t number) { return std::sin(double(number)) + 1e-3 * double(number); }

std::vector<ChartPoint> points_up_to(std::uint64_t last, std::uint64_t step = 1) {
  ChartPoints points;
  for (std::uint64_t number = 1; number <= last; number += step) {
    points.add(number, value_at(number));
  }
  return points.result();
}

TEST(ChartPoints, AreAllShownWhileTheyAreFew) {
  EXPECT_TRUE(points_up_to(0).empty());
  const std::vector<ChartPoint> points = points_up_to(400);
  ASSERT_EQ(points.size(), 400u);
  for (std::uint64_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].first, i + 1);
    EXPECT_EQ(points[i].last, i + 1);
    EXPECT_EQ(points[i].lowest, value_at(i + 1));
    EXPECT_EQ(points[i].mean, value_at(i + 1));
    EXPECT_EQ(points[i].highest, value_at(i + 1));
  }
}

TEST(ChartPoints, AreHalvedWhenOneMoreComes) {
  const std::vector<ChartPoint> points = points_up_to(401);
  ASSERT_EQ(points.size(), 201u);
  EXPECT_EQ(points[0].first, 1u);
  EXPECT_EQ(points[0].last, 2u);
  EXPECT_EQ(points[200].first, 401u);
  EXPECT_EQ(points[200].last, 401u);
}

TEST(ChartPoints, HoldWhatTheyStandFor) {
  for (const std::uint64_t last : {401u, 799u, 1000u, 12345u}) {
    const std::vector<ChartPoint> points = points_up_to(last);
    EXPECT_LE(points.size(), ChartPoints::most);
    EXPECT_GT(points.size(), ChartPoints::most / 2);
    std::uint64_t next = 1;
    for (const ChartPoint& point : points) {
      ASSERT_EQ(point.first, next);
      next = point.last + 1;
      std::vector<double> values;
      double sum = 0.0;
      for (std::uint64_t number = point.first; number <= point.last; ++number) {
        values.push_back(value_at(number));
        sum += values.back();
      }
      EXPECT_EQ(point.lowest, *std::min_element(values.begin(), values.end()));
      EXPECT_EQ(point.highest, *std::max_element(values.begin(), values.end()));
      EXPECT_TRUE(test::is_close_relative(point.mean, sum / double(values.size()), rounding));
    }
    EXPECT_EQ(next, last + 1);
  }
}

TEST(ChartPoints, StandForAsManyEachButTheLast) {
  for (const std::uint64_t last : {401u, 801u, 1601u, 100000u}) {
    const std::vector<ChartPoint> points = points_up_to(last);
    const std::uint64_t values = points[0].last;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      ASSERT_EQ(points[i].last, (i + 1) * values) << last;
    }
    EXPECT_LE(points.back().last - points.back().first, values - 1);
  }
}

TEST(ChartPoints, WeighValuesAndNotNumbersWhereSomeAreLeftOut) {
  const std::vector<ChartPoint> points = points_up_to(1201, 3);
  ASSERT_EQ(points.size(), 201u);
  EXPECT_EQ(points[1].first, 7u);
  EXPECT_EQ(points[1].last, 10u);
  EXPECT_TRUE(
      test::is_close_relative(points[1].mean, (value_at(7) + value_at(10)) / 2.0, rounding));
}

TEST(ChartPoints, AreFewForAMillion) {
  const std::vector<ChartPoint> points = points_up_to(1000000);
  EXPECT_LE(points.size(), ChartPoints::most);
  EXPECT_EQ(points.back().last, 1000000u);
}

}  // namespace
}  // namespace gonio

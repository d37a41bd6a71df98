#include "emulator/statistics/running_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using test::is_close_relative;

constexpr double rounding = 1e-12;

RunningStatistics statistics_of(const std::vector<double>& values) {
  RunningStatistics statistics;
  for (const double value : values) {
    statistics.add(value);
  }
  return statistics;
}

TEST(RunningStatistics, AreNoneWithoutValues) {
  const ChannelStatistics none = RunningStatistics().result();
  EXPECT_EQ(none.n, 0);
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.standard_deviation, 0.0);
  EXPECT_EQ(none.range(), 0.0);
}

TEST(RunningStatistics, HaveNoStandardDeviationOfOneValue) {
  const ChannelStatistics one = statistics_of({-3.7}).result();
  EXPECT_EQ(one.n, 1);
  EXPECT_EQ(one.mean, -3.7);
  EXPECT_EQ(one.minimum, -3.7);
  EXPECT_EQ(one.maximum, -3.7);
  EXPECT_EQ(one.standard_deviation, 0.0);
}

// Seed 7.
TEST(RunningStatistics, EqualTheFormulasOfAllValuesAtOnce) {
  std::mt19937_64 random(7);
  std::vector<double> x(999);
  std::generate(x.begin(), x.end(), [&] { return 80.0 + double(random() % 1000) / 1000.0; });
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / double(x.size());
  double squares = 0.0;
  for (const double value : x) {
    squares += (value - mean) * (value - mean);
  }
  const ChannelStatistics got = statistics_of(x).result();
  EXPECT_EQ(got.n, 999);
  EXPECT_TRUE(is_close_relative(got.mean, mean, rounding));
  EXPECT_TRUE(is_close_relative(got.standard_deviation, std::sqrt(squares / 998.0), rounding));
  EXPECT_EQ(got.minimum, *std::min_element(x.begin(), x.end()));
  EXPECT_EQ(got.maximum, *std::max_element(x.begin(), x.end()));
  EXPECT_EQ(got.range(), got.maximum - got.minimum);
}

TEST(RunningStatistics, OfEqualValuesAreThatValueToTheLastBit) {
  const ChannelStatistics got = statistics_of(std::vector<double>(100, 83.38410071616812)).result();
  EXPECT_EQ(got.mean, 83.38410071616812);
  EXPECT_EQ(got.standard_deviation, 0.0);
}

// The sum of squares less the square of the sum would lose all digits here.
TEST(RunningStatistics, KeepTheirDigitsFarFromZero) {
  const ChannelStatistics got = statistics_of({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}).result();
  EXPECT_TRUE(is_close_relative(got.standard_deviation, std::sqrt(30.0), rounding));
}

}  // namespace
}  // namespace gonio

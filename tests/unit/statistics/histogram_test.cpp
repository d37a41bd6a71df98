#include "emulator/statistics/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace gonio {
namespace {

Histogram histogram_of(const std::vector<double>& values) {
  Histogram histogram;
  std::for_each(values.begin(), values.end(), [&](double value) { histogram.add(value); });
  return histogram;
}

std::uint64_t total(const Histogram::Bins& bins) {
  return std::accumulate(bins.counts.begin(), bins.counts.end(), std::uint64_t(0));
}

std::vector<double> normal_values(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> distribution(85.0, 1.5);
  std::vector<double> values(n);
  std::generate(values.begin(), values.end(), [&] { return distribution(random); });
  return values;
}

TEST(Histogram, HasNoBinsWithoutValues) { EXPECT_TRUE(Histogram().bins().counts.empty()); }

TEST(Histogram, OfEqualValuesIsOneBinWithoutWidth) {
  const Histogram::Bins bins = histogram_of({3.7, 3.7, 3.7}).bins();
  EXPECT_EQ(bins.low, 3.7);
  EXPECT_EQ(bins.width, 0.0);
  EXPECT_EQ(bins.counts, std::vector<std::uint64_t>{3});
}

// Seed 3; 10000 values.
TEST(Histogram, CountsEachValueInTheBinThatHoldsIt) {
  const std::vector<double> values = normal_values(10000, 3);
  for (const std::size_t most : {1u, 7u, 40u, 256u, 1000u}) {
    const Histogram::Bins bins = histogram_of(values).bins(most);
    ASSERT_LE(bins.counts.size(), most);
    EXPECT_EQ(total(bins), values.size());
    for (std::size_t i = 0; i < bins.counts.size(); ++i) {
      const double low = bins.low + double(i) * bins.width;
      EXPECT_EQ(bins.counts[i],
                std::uint64_t(std::count_if(values.begin(), values.end(), [&](double value) {
                  return low <= value && value < low + bins.width;
                })));
    }
  }
}

// Seed 3. The width is the smallest power of two that will do: at least 127 bins.
TEST(Histogram, KeepsFineBins) {
  const std::vector<double> values = normal_values(10000, 3);
  const Histogram::Bins fine = histogram_of(values).bins(256);
  EXPECT_GE(fine.counts.size(), 127u);
  EXPECT_LE(fine.counts.size(), 256u);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  EXPECT_LE(fine.low, *low);
  EXPECT_GT(fine.low + fine.width, *low);
  EXPECT_GT(fine.low + fine.width * double(fine.counts.size()), *high);
  EXPECT_LE(fine.low + fine.width * double(fine.counts.size() - 1), *high);
}

// 0 to 255 takes 256 bins of width 1; one more to either side needs width 2.
TEST(Histogram, WidensForTheFirstValueThatDoesNotFit) {
  EXPECT_EQ(histogram_of({0.0, 255.0}).bins(1000).width, 1.0);
  EXPECT_EQ(histogram_of({0.0, 255.0}).bins(1000).counts.size(), 256u);
  for (const double outside : {-1.0, 256.0}) {
    const Histogram::Bins bins = histogram_of({0.0, 255.0, outside}).bins(1000);
    EXPECT_EQ(bins.width, 2.0);
    EXPECT_EQ(bins.counts.size(), 129u);
    EXPECT_EQ(total(bins), 3u);
  }
}

TEST(Histogram, JoinsNeighboursToFewerBins) {
  const Histogram histogram = histogram_of(normal_values(10000, 3));
  const Histogram::Bins fine = histogram.bins(256), few = histogram.bins(40);
  const auto joined = std::size_t(std::lround(few.width / fine.width));
  EXPECT_EQ(few.low, fine.low);
  for (std::size_t i = 0; i < few.counts.size(); ++i) {
    const auto first = fine.counts.begin() + std::ptrdiff_t(i * joined);
    const auto last =
        fine.counts.begin() + std::ptrdiff_t(std::min((i + 1) * joined, fine.counts.size()));
    EXPECT_EQ(few.counts[i], std::accumulate(first, last, std::uint64_t(0)));
  }
}

TEST(Histogram, IsTheSameForValuesInAnyOrder) {
  std::vector<double> values = normal_values(2000, 5);
  values.insert(values.end(), {-1e3, 0.0, 1e4, 84.9999999});
  const Histogram::Bins given = histogram_of(values).bins(256);
  const auto expect_same = [&] {
    const Histogram::Bins got = histogram_of(values).bins(256);
    EXPECT_EQ(got.low, given.low);
    EXPECT_EQ(got.width, given.width);
    EXPECT_EQ(got.counts, given.counts);
  };
  std::sort(values.begin(), values.end());
  expect_same();
  std::reverse(values.begin(), values.end());
  expect_same();
  // From the middle outwards: each value widens what there is.
  std::sort(values.begin(), values.end(),
            [](double a, double b) { return std::abs(a - 85.0) < std::abs(b - 85.0); });
  expect_same();
}

TEST(Histogram, HoldsValuesOfAnySizeInAFewBins) {
  const double largest = std::numeric_limits<double>::max();
  const double smallest = std::numeric_limits<double>::denorm_min();
  for (const std::vector<double>& values :
       std::vector<std::vector<double>>{{0.0, smallest},
                                        {1.0, std::nextafter(1.0, 2.0)},
                                        {1.0, std::nextafter(1.0, 0.0), -1.0},
                                        {smallest, 1.0, largest},
                                        {largest, -largest},
                                        {-smallest, 0.0, smallest, 1e300, -1e-300},
                                        {0.0, -0.0, 5.0}}) {
    const Histogram::Bins bins = histogram_of(values).bins(256);
    EXPECT_LE(bins.counts.size(), 256u);
    EXPECT_GE(bins.counts.size(), 2u);
    EXPECT_EQ(total(bins), values.size());
    EXPECT_GT(bins.width, 0.0);
  }
}

TEST(Histogram, RefusesWhatIsNotANumber) {
  Histogram histogram;
  EXPECT_THROW(histogram.add(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
  EXPECT_THROW(histogram.add(std::numeric_limits<double>::infinity()), std::domain_error);
  EXPECT_THROW((void)histogram.bins(0), std::domain_error);
  EXPECT_TRUE(histogram.bins().counts.empty());
}

}  // namespace
}  // namespace gonio

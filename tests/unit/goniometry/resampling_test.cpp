#include "emulator/goniometry/resampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace gonio::test {
namespace {

using Eigen::ArrayXd;

constexpr double rounding = 1e-12;  // relative, of sums of a hundred terms

std::vector<bool> all_valid(const ArrayXd& pixels) {
  return std::vector<bool>(std::size_t(pixels.size()), true);
}

TEST(BandWeights, KeepTheSumOfCountsWherePixelsAreFiner) {
  // Pixels of 0.5 nm whose borders are those of the bands: nothing is lost at the ends.
  const ArrayXd pixels = ArrayXd::LinSpaced(100, 400.25, 449.75);
  const ArrayXd counts = 100.0 + 50.0 * (pixels / 7.0).sin();
  const WavelengthGrid grid(nanometres(402.5), nanometres(5), 10);
  double sum = 0.0;
  for (const BandWeights& band : band_weights(pixels, all_valid(pixels), grid)) {
    EXPECT_TRUE(band.is_mean);
    sum += 5.0 * band_density(band, counts);
  }
  EXPECT_NEAR(sum, counts.sum(), rounding * counts.sum());
}

TEST(BandWeights, KeepTheSumOfCountsOfPixelsOfUnequalWidth) {
  // Every band is covered; pixels that a border cuts count by their share on each side.
  ArrayXd pixels(60);
  for (Eigen::Index p = 0; p < 60; ++p) {
    pixels(p) = 400.0 + 0.6 * double(p) + 2e-3 * double(p * p);
  }
  const ArrayXd counts = ArrayXd::LinSpaced(60, 10.0, 200.0);
  const WavelengthGrid coarse(nanometres(405), nanometres(4), 8);
  const WavelengthGrid fine(nanometres(404), nanometres(2), 16);
  double of_coarse = 0.0;
  double of_fine = 0.0;
  for (const BandWeights& band : band_weights(pixels, all_valid(pixels), coarse)) {
    of_coarse += 4.0 * band_density(band, counts);
  }
  for (const BandWeights& band : band_weights(pixels, all_valid(pixels), fine)) {
    of_fine += 2.0 * band_density(band, counts);
  }
  EXPECT_NEAR(of_fine, of_coarse, rounding * of_coarse) << "both cover 403 to 435 nm";
}

TEST(BandWeights, AreLinearWherePixelsLieWider) {
  const ArrayXd pixels = ArrayXd::LinSpaced(5, 400.0, 440.0);
  const ArrayXd counts = 2.0 * pixels;  // a density of 0.2 lambda / nm
  const WavelengthGrid grid(nanometres(402), nanometres(3), 10);
  const auto bands = band_weights(pixels, all_valid(pixels), grid);
  for (Eigen::Index j = 0; j < grid.size(); ++j) {
    EXPECT_FALSE(bands[std::size_t(j)].is_mean);
    EXPECT_NEAR(band_density(bands[std::size_t(j)], counts), 0.2 * grid.nanometres()(j), 1e-10);
  }
}

TEST(BandWeights, LeaveOutPixelsThatAreNotValid) {
  const ArrayXd pixels = ArrayXd::LinSpaced(20, 400.5, 419.5);
  ArrayXd counts = ArrayXd::Constant(20, 7.0);
  std::vector<bool> is_valid = all_valid(pixels);
  for (const std::size_t bad : {2u, 10u, 11u, 12u}) {
    is_valid[bad] = false;
    counts(Eigen::Index(bad)) = 65535.0;
  }
  const auto bands =
      band_weights(pixels, is_valid, WavelengthGrid(nanometres(402.5), nanometres(5), 4));
  EXPECT_NEAR(band_density(bands[0], counts), 7.0, 1e-12) << "the mean of four of five pixels";
  EXPECT_EQ(bands[2].weight.size(), 0) << "two of five pixels do not make a band";
  EXPECT_NEAR(band_density(bands[3], counts), 7.0, 1e-12);
}

TEST(BandWeights, HaveNoValueBeyondThePixels) {
  const ArrayXd pixels = ArrayXd::LinSpaced(20, 400.5, 419.5);
  const auto bands =
      band_weights(pixels, all_valid(pixels), WavelengthGrid(nanometres(390), nanometres(5), 9));
  EXPECT_EQ(bands.front().weight.size(), 0);
  EXPECT_EQ(bands.back().weight.size(), 0);
}

TEST(BandWeights, PropagateTheVarianceOfIndependentPixels) {
  const ArrayXd pixels = ArrayXd::LinSpaced(20, 400.5, 419.5);
  const auto bands =
      band_weights(pixels, all_valid(pixels), WavelengthGrid(nanometres(402.5), nanometres(5), 4));
  EXPECT_NEAR(band_variance(bands[1], ArrayXd::Constant(20, 5.0)), 1.0, 1e-12)
      << "of the mean of five";
}

TEST(BandWeights, RefusePixelsThatDoNotAscend) {
  EXPECT_THROW((void)band_weights(ArrayXd::Constant(3, 400.0), {true, true, true},
                                  WavelengthGrid::visible()),
               std::invalid_argument);
}

}  // namespace
}  // namespace gonio::test

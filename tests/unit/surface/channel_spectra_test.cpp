#include "emulator/surface/channel_spectra.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using Band = BrdfChannel::Band;
using test::is_close;

constexpr double rounding = 1e-9;
const WavelengthGrid grid = WavelengthGrid::visible();
const std::vector<BrdfChannel> rgb{
    {.band = Band::red}, {.band = Band::green}, {.band = Band::blue}};
const std::vector<BrdfChannel> xyz{{.band = Band::x}, {.band = Band::y}, {.band = Band::z}};

BrdfChannel at(double lambda_nm) {
  return {.band = Band::wavelength, .wavelength = nanometres(lambda_nm)};
}

TEST(ChannelSpectra, SumToOneSoThatGreyStaysGrey) {
  for (const auto& channels :
       {rgb, xyz, std::vector{at(400), at(550), at(600)}, {{.band = Band::luminance}}}) {
    const Eigen::ArrayXd sum = channel_spectra(channels, grid).colwise().sum().transpose();
    EXPECT_TRUE(is_close((sum - 1.0).abs().maxCoeff(), 0.0, rounding));
  }
}

TEST(ChannelSpectra, OfRgbAreNotNegative) {
  EXPECT_GE(channel_spectra(rgb, grid).minCoeff(), -rounding);
}

TEST(ChannelSpectra, FollowTheOrderOfTheChannels) {
  const Eigen::MatrixXd spectra = channel_spectra(rgb, grid);
  const Eigen::MatrixXd reversed = channel_spectra({rgb[2], rgb[1], rgb[0]}, grid);
  EXPECT_EQ(reversed.row(0), spectra.row(2));
  EXPECT_EQ(reversed.row(2), spectra.row(0));
}

TEST(ChannelSpectra, OfWavelengthsAreLinearBetweenThemAndConstantBeyond) {
  const WavelengthGrid five(nanometres(400), nanometres(50), 5);
  const Eigen::MatrixXd spectra = channel_spectra({at(450), at(550)}, five);
  Eigen::MatrixXd expected(2, 5);
  expected << 1.0, 1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0;
  EXPECT_TRUE(is_close((spectra - expected).cwiseAbs().maxCoeff(), 0.0, rounding));
}

TEST(ChannelSpectra, NeedAllChannelsOfOneKind) {
  EXPECT_THROW(static_cast<void>(channel_spectra({}, grid)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(channel_spectra({rgb[0], rgb[1]}, grid)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(channel_spectra({rgb[0], rgb[1], rgb[1]}, grid)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(channel_spectra({at(500), at(400)}, grid)), std::invalid_argument);
}

}  // namespace
}  // namespace gonio

#include "emulator/measured/brdf_resampling.hpp"

#include <gtest/gtest.h>

#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/brdf_file.hpp"
#include "emulator/measured/brdf_reflectance.hpp"
#include "emulator/measured/sampled_brdf.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/slice_errors.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

/// Through samples and ASTM text, and back.
SampledBrdf by_astm(const MeasuredBrdf& brdf, const BrdfSampling& sampling = {}) {
  std::vector<std::string> warnings;
  const std::string text = astm_text(sample_brdf(brdf, sampling));
  SampledBrdf result(parse_astm(text, "text"), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return result;
}

TEST(BrdfResampling, OfRglToAstmKeepsTheReferenceSlices) {
  constexpr double at_nodes = 1e-4;  // as the RGL file itself is asked to
  constexpr double between_nodes = 0.02, reflectance = 0.005, reflectance_at_75 = 0.02;
  for (const std::string material : {"colodur_napoli_4f", "satin_rosaline", "paper_white"}) {
    const BrdfFile rgl = load_brdf(brdf_fixtures + material + "_rgb.bsdf");
    const SampledBrdf astm = by_astm(*rgl.brdf);
    for (const double theta_i : {0.0, 5.0, 20.0, 45.0, 60.0, 75.0}) {
      EXPECT_LT(slice_errors(astm, material, theta_i).largest, at_nodes) << material << theta_i;
      const double rho = directional_hemispherical_reflectance(*rgl.brdf, degrees(theta_i))[1];
      EXPECT_TRUE(
          is_close_relative(directional_hemispherical_reflectance(astm, degrees(theta_i))[1], rho,
                            theta_i < 75.0 ? reflectance : reflectance_at_75))
          << material << theta_i;
    }
    for (const double theta_i : {2.5, 17.5, 52.5, 72.5}) {
      EXPECT_TRUE(is_close_relative(in_plane(astm, theta_i, theta_i)[1],
                                    in_plane(*rgl.brdf, theta_i, theta_i)[1], between_nodes))
          << material << theta_i;
    }
  }
}

TEST(BrdfResampling, OfZemaxToAstmKeepsItsTable) {
  const BrdfFile zemax = load_brdf(brdf_fixtures + "satin_rosaline.zemax.bsdf");
  const SampledBrdf astm = by_astm(
      *zemax.brdf, {.theta_i = {degrees(0.0), degrees(20.0), degrees(45.0), degrees(60.0)}});
  constexpr double between_nodes = 0.05;
  for (const double theta_i : {0.0, 20.0, 45.0, 60.0}) {
    for (const double theta_r : {-40.0, 0.0, theta_i - 2.0, theta_i, theta_i + 3.0, 75.0}) {
      EXPECT_TRUE(is_close_relative(in_plane(astm, theta_i, theta_r)[0],
                                    in_plane(*zemax.brdf, theta_i, theta_r)[0], between_nodes))
          << theta_i << " " << theta_r;
    }
  }
  EXPECT_DOUBLE_EQ(astm.largest_theta().degrees(), 60.0);
}

TEST(BrdfResampling, KeepsRotationsApart) {
  const BrdfFile zemax = load_brdf(brdf_fixtures + "satin_rosaline.zemax.bsdf");
  const BrdfSamples samples =
      sample_brdf(*zemax.brdf, {.theta_i = {degrees(20.0)}, .rotation = {degrees(0), degrees(90)}});
  EXPECT_GT(samples.phi_i.maxCoeff(), samples.phi_i.minCoeff() + 1.0);
  EXPECT_LT((samples.phi_r - (samples.phi_i - std::numbers::pi)).minCoeff(), -1.0);  // both sides
  std::vector<std::string> warnings;
  const SampledBrdf again(samples, warnings);
  constexpr double between_nodes = 0.02;
  const Vector3 omega_i = direction_at(20.0, 270.0), omega_r = direction_at(24.0, 95.0);
  EXPECT_TRUE(is_close_relative(value_of(again, omega_i, omega_r)[0],
                                value_of(*zemax.brdf, omega_i, omega_r)[0], between_nodes));
}

TEST(BrdfResampling, RefusesGridsBeyondReason) {
  const BrdfFile zemax = load_brdf(brdf_fixtures + "satin_rosaline.zemax.bsdf");
  EXPECT_EQ(message_of([&] {
              (void)sample_brdf(*zemax.brdf,
                                {.theta_step = degrees(0.1), .azimuth_step = degrees(0.5)});
            }),
            "expected a grid of at most 2000000 samples: take larger steps, or fewer angles of "
            "incidence");
}

TEST(ChannelConversion, MakesLuminanceOfColour) {
  using Band = BrdfChannel::Band;
  const std::vector<BrdfChannel> rgb{
      {.band = Band::red}, {.band = Band::green}, {.band = Band::blue}};
  const std::vector<BrdfChannel> xyz{{.band = Band::x}, {.band = Band::y}, {.band = Band::z}};
  const std::vector<BrdfChannel> luminance{{.band = Band::luminance}};
  EXPECT_DOUBLE_EQ(channel_conversion(rgb, luminance).sum(), 1.0);
  EXPECT_EQ(channel_conversion(xyz, luminance), Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(channel_conversion(rgb, {rgb[2]}), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(message_of([&] { (void)channel_conversion(rgb, xyz); }),
            "expected a channel of the file, which has R to B, found 'X'");
  const BrdfFile rgl = load_brdf(brdf_fixtures + "satin_rosaline_rgb.bsdf");
  const auto grey = with_channels(rgl.brdf, luminance);
  const Eigen::ArrayXd colour = in_plane(*rgl.brdf, 45.0, 45.0);
  EXPECT_DOUBLE_EQ(in_plane(*grey, 45.0, 45.0)[0],
                   0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]);
}

}  // namespace
}  // namespace gonio::test

#include "emulator/goniometry/scan_lobe.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "emulator/goniometry/scan_samples.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

const WavelengthGrid two(nanometres(500), nanometres(50), 2);

ScanPlan around(const char* polar, const char* azimuth) {
  ScanPlan plan;
  plan.theta_i = {degrees(40)};
  plan.theta_r = *parse_angles(polar);
  plan.phi_r = *parse_angles(azimuth);
  plan.source = plan.receptor = *parse_opening("1 deg");
  plan.grid = two;
  return plan;
}

ScanResult scanned(const Surface& surface, const ScanPlan& plan) {
  Sample sample;
  sample.surface = surface;
  return scan(sample, plan, scan_light(plan, test::shipped()));
}

Surface rough() {
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(2, {0.6, 2.6});
  return cook_torrance(two, 0.35, n_hat, {}, Normalization::energy_conserving);
}

TEST(HemisphereWeights, AddUpToPi) {
  for (const auto& [polar, azimuth] :
       {std::pair{"0:85:5 deg", "0:350:10 deg"}, std::pair{"2:86:4 deg", "-170:180:10 deg"},
        std::pair{"0:80:20 deg", "0:180:15 deg"}}) {
    const auto weights = hemisphere_weights(around(polar, azimuth).positions(), true);
    ASSERT_TRUE(weights) << polar << azimuth;
    EXPECT_NEAR(weights->sum(), std::numbers::pi, 1e-12);
  }
}

TEST(HemisphereWeights, NeedAReceptorThatGoesAllRound) {
  EXPECT_FALSE(hemisphere_weights(around("-85:85:5 deg", "0 deg").positions(), true));
  EXPECT_FALSE(hemisphere_weights(around("0:85:5 deg", "0 deg").positions(), true));
  EXPECT_FALSE(hemisphere_weights(around("0:70:5 deg", "0:350:10 deg").positions(), true));
  EXPECT_FALSE(hemisphere_weights(around("0:85:5 deg", "0:180:15 deg").positions(), false));
  EXPECT_FALSE(hemisphere_weights(around("0:85:5 deg", "0:270:90 deg").positions(), true));
}

TEST(ScanLobes, AddUpToTheReflectanceIntoTheHemisphere) {
  const ScanResult result = scanned(rough(), around("0:88:2 deg", "0:355:5 deg"));
  const auto lobes = scan_lobes(result);
  ASSERT_EQ(lobes.size(), 1U);
  ASSERT_TRUE(lobes.front().hemispherical);
  const Flux whole = ApertureIntegrator().hemispherical(rough(), source_frame(degrees(40)).axis,
                                                        result.light.weight, 1e-6);
  constexpr double of_the_steps = 5e-3;  // relative; second order in steps of 2 and 5 deg
  EXPECT_LE((*lobes.front().hemispherical / whole.spectral - 1.0).abs().maxCoeff(), of_the_steps);
}

TEST(ScanLobes, OfALambertianSurfaceAddUpToItsReflectanceThoughHeadsCollide) {
  const ScanResult result =
      scanned(lambertian(two, ArrayXd::Constant(2, 0.7)), around("0:85:5 deg", "0:345:15 deg"));
  constexpr double tolerance = 1e-4;
  EXPECT_NEAR((*scan_lobes(result).front().hemispherical)(0), 0.7, 0.7 * tolerance);
}

TEST(ScanLobes, FindThePeakPastTheMirrorDirectionOfARoughSurface) {
  ScanPlan plan = around("-80:80:1 deg", "0 deg");
  plan.theta_i = {degrees(20), degrees(60)};
  const ScanResult result = scanned(rough(), plan);
  const auto lobes = scan_lobes(result);
  ASSERT_EQ(lobes.size(), 2U);
  const ScanPosition& peak = result.positions[std::size_t(lobes[1].peak)];
  EXPECT_GT(peak.theta_r.degrees(), 61.0);
  EXPECT_NEAR(lobes[1].from_mirror.degrees(), peak.theta_r.degrees() - 60.0, 1e-9);
}

TEST(BrdfSamplesOfAScan, HoldWhatIsKnown) {
  ScanPlan plan = around("-80:80:10 deg", "0 deg");
  plan.rotation = {degrees(30)};
  const ScanResult result = scanned(rough(), plan);
  const BrdfSamples samples = brdf_samples(result, plan, "copper");
  EXPECT_EQ(samples.size(), result.size() - 1);  // one is blocked, at -40 deg
  EXPECT_EQ(samples.channels.size(), 2U);
  EXPECT_EQ(samples.notes.at("SAMPLE_NAME"), "copper");
  EXPECT_EQ(samples.notes.at("RECEIVER_APERTURE"), "circle 1 deg");
  EXPECT_NEAR(samples.phi_i(0), degrees(150).radians(), 1e-12);
  EXPECT_NEAR(samples.phi_r(0), degrees(150).radians(), 1e-12);  // past the normal
  EXPECT_NEAR(samples.theta_r(0), degrees(80).radians(), 1e-12);
  EXPECT_EQ(samples.f_r(0, 1), result.f_r(1, 0));
}

}  // namespace
}  // namespace gonio

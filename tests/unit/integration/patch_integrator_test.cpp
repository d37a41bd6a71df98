#include "emulator/integration/patch_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "emulator/integration/aperture_integrator.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/glossmeter.hpp"

namespace gonio {
namespace {

using test::collimated_glossmeter;
using test::constant_index;
using test::is_close;
using test::one_wavelength;
using test::whole_weight;

constexpr double unused_tolerance = 0.0;  // patches have the error they have

Surface rough_glass(double m) { return cook_torrance(one_wavelength, m, constant_index(1.567)); }

/// By how much patches err in the flux of a glossmeter with a collimated source, in percent.
double error_percent(Eigen::Index resolution, double theta_deg, double m) {
  const MeasuringGeometry geometry = collimated_glossmeter(theta_deg);
  const double expected = test::flux_of(rough_glass(m), geometry, 1e-12);
  const Flux flux = PatchIntegrator(resolution)
                        .reflected(rough_glass(m), geometry, whole_weight, unused_tolerance);
  return 100.0 * (flux.spectral(0) / expected - 1.0);
}

TEST(PatchIntegrator, ErrsInGlossByWhatAnotherProgramFoundForItsLayout) {
  // Hemicube patches by their centre, collimated source; percent, to half of the last digit.
  struct Row {
    Eigen::Index resolution;
    double theta_deg, m, percent, digit;
  };
  const std::vector<Row> rows = {
      {128, 20, 0.02, -13.9, 0.1}, {128, 20, 0.05, -16.9, 0.1}, {128, 60, 0.02, -4.4, 0.1},
      {128, 60, 0.05, -7.7, 0.1},  {128, 60, 0.10, -7.9, 0.1},  {128, 85, 0.02, -95, 1},
      {128, 85, 0.05, -2.7, 0.1},  {256, 20, 0.02, 4.6, 0.1},   {256, 20, 0.05, 3.0, 0.1},
      {256, 60, 0.02, 3.4, 0.1},   {256, 60, 0.05, 6.1, 0.1},   {256, 60, 0.10, 6.2, 0.1},
      {256, 85, 0.02, -27, 1},     {256, 85, 0.05, 0.5, 0.1},   {1024, 20, 0.02, 3.4, 0.1},
      {1024, 20, 0.05, 3.5, 0.1},  {1024, 60, 0.02, -0.4, 0.1}, {1024, 60, 0.05, -0.8, 0.1},
      {1024, 60, 0.10, -0.8, 0.1}, {1024, 85, 0.02, 0.0, 0.1},  {1024, 85, 0.05, 0.0, 0.1}};
  for (const Row& row : rows) {
    EXPECT_TRUE(is_close(error_percent(row.resolution, row.theta_deg, row.m), row.percent,
                         0.5 * row.digit * (1 + 1e-6)))
        << "N = " << row.resolution << ", " << row.theta_deg << " deg, m = " << row.m;
  }
}

TEST(PatchIntegrator, HasTheNumberOfPatchesOfThePaper) {
  EXPECT_EQ(PatchIntegrator().patch_count(), 196'608);
  EXPECT_EQ(PatchIntegrator(128).patch_count(), 49'152);
  EXPECT_EQ(PatchIntegrator(1024).patch_count(), 3'145'728);
}

/// A Lambert-like shape without its cosine: what it reflects is the solid angle over pi.
class PerCosine : public Shape {
 public:
  void evaluate(double, const Vector3&, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXd> g) const override {
    g = omega_r.z.inverse() / std::numbers::pi;
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override { return {}; }
};

double solid_angle_of_patches(Eigen::Index resolution) {
  Surface surface{.grid = one_wavelength};
  surface.lobes.push_back({.shape = std::make_shared<PerCosine>(),
                           .colour = [](double) -> Eigen::ArrayXd { return whole_weight; }});
  return std::numbers::pi *
         PatchIntegrator(resolution)
             .hemispherical(surface, Vector3::UnitZ(), whole_weight, unused_tolerance)
             .spectral(0);
}

TEST(PatchIntegrator, CoversTheHemisphereWithItsPatches) {
  // The midpoint rule errs by the step squared: 2.5e-5 of 2 pi at N = 128, a quarter at twice that.
  const double whole = 2.0 * std::numbers::pi;
  const double error_128 = solid_angle_of_patches(128) - whole;
  const double error_256 = solid_angle_of_patches(256) - whole;
  EXPECT_TRUE(is_close(error_256, 0.0, 1e-4));
  EXPECT_TRUE(is_close(error_128 / error_256, 4.0, 0.05));
}

TEST(PatchIntegrator, HasTheReflectanceIntoTheHemisphereOfTheApertureIntegrator) {
  constexpr double tolerance = 1e-6;
  for (const double theta : {0.0, 20.0, 60.0}) {
    const Vector3 omega_i = source_frame(degrees(theta)).axis;
    for (const double m : {0.02, 0.05, 0.1}) {
      const double expected = ApertureIntegrator()
                                  .hemispherical(rough_glass(m), omega_i, whole_weight, 1e-9)
                                  .spectral(0);
      const double got = PatchIntegrator()
                             .hemispherical(rough_glass(m), omega_i, whole_weight, unused_tolerance)
                             .spectral(0);
      EXPECT_TRUE(is_close(got, expected, tolerance)) << theta << " deg, m = " << m;
    }
  }
}

TEST(PatchIntegrator, ReportsThatItIsTooCoarseForANarrowLobeAt85Deg) {
  const Vector3 omega_i = source_frame(degrees(85)).axis;
  const Surface surface = rough_glass(0.02);
  const Flux exact = ApertureIntegrator().hemispherical(surface, omega_i, whole_weight, 1e-9);
  const Flux patches =
      PatchIntegrator().hemispherical(surface, omega_i, whole_weight, unused_tolerance);
  const double error = std::abs(patches.spectral(0) - exact.spectral(0));
  EXPECT_GT(error, 0.1);
  EXPECT_GT(patches.error, 0.5 * error);
}

TEST(PatchIntegrator, ReportsAnErrorAboutAsLargeAsItsErrorInGloss) {
  // An estimate and no bound: it must not be an order of magnitude too small.
  for (const double theta : {20.0, 60.0, 85.0}) {
    for (const double m : {0.02, 0.05, 0.1}) {
      const MeasuringGeometry geometry = collimated_glossmeter(theta);
      const double expected = test::flux_of(rough_glass(m), geometry, 1e-12);
      const Flux flux =
          PatchIntegrator().reflected(rough_glass(m), geometry, whole_weight, unused_tolerance);
      EXPECT_GT(flux.error, 0.1 * std::abs(flux.spectral(0) - expected))
          << theta << " deg, m = " << m;
    }
  }
}

TEST(PatchIntegrator, MeasuresWithTheCircularAperturesOfThePaper) {
  constexpr double diameter_deg = 4.7;
  constexpr double edges = 0.1;  // relative, of patches cut by the edge
  for (const double theta : {20.0, 60.0}) {
    const MeasuringGeometry geometry{
        Aperture::circle(source_frame(degrees(theta)), degrees(diameter_deg)),
        Aperture::circle(receptor_frame(degrees(theta)), degrees(diameter_deg))};
    const double expected = test::flux_of(rough_glass(0.1), geometry, 1e-10);
    const Flux flux =
        PatchIntegrator().reflected(rough_glass(0.1), geometry, whole_weight, unused_tolerance);
    EXPECT_TRUE(test::is_close_relative(flux.spectral(0), expected, edges)) << theta;
    EXPECT_TRUE(test::is_close_relative(PatchIntegrator().incident(geometry.source),
                                        ApertureIntegrator().incident(geometry.source), edges))
        << theta;
  }
}

TEST(PatchIntegrator, SendsASmoothSurfacesPatchesToTheMirrorDirection) {
  const Surface mirror = smooth(one_wavelength, 0.8);
  const MeasuringGeometry geometry = test::glossmeter(60.0);
  const PatchIntegrator patches;
  const Flux flux = patches.reflected(mirror, geometry, whole_weight, unused_tolerance);
  EXPECT_TRUE(
      test::is_close_relative(flux.spectral(0), 0.8 * patches.incident(geometry.source), 1e-12));
}

TEST(PatchIntegrator, RefusesAResolutionThatIsNoMultipleOf4) {
  for (const Eigen::Index bad : {0, -4, 2, 6, 255}) {
    EXPECT_THROW(PatchIntegrator{bad}, std::domain_error) << bad;
  }
}

}  // namespace
}  // namespace gonio

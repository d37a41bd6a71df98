#include "emulator/goniometry/scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

const WavelengthGrid three(nanometres(450), nanometres(100), 3);

ScanOpening circle(double diameter_deg) {
  return {.in_plane = degrees(diameter_deg), .perpendicular = degrees(diameter_deg)};
}

ScanOpening rectangle(double in_plane_deg, double perpendicular_deg) {
  return {.outline = Aperture::Outline::rectangle,
          .in_plane = degrees(in_plane_deg),
          .perpendicular = degrees(perpendicular_deg)};
}

std::vector<Angle> in_degrees(const std::vector<double>& values) {
  std::vector<Angle> angles;
  for (const double value : values) {
    angles.push_back(degrees(value));
  }
  return angles;
}

ScanPlan plan_of(const std::vector<double>& theta_i, const std::vector<double>& theta_r,
                 const std::vector<double>& phi_r = {0.0}) {
  ScanPlan plan;
  plan.theta_i = in_degrees(theta_i);
  plan.theta_r = in_degrees(theta_r);
  plan.phi_r = in_degrees(phi_r);
  plan.grid = three;
  plan.heads_apart = {};
  plan.reciprocity = UseOfReciprocity::no;
  return plan;
}

ScanResult scanned(const Surface& surface, const ScanPlan& plan) {
  Sample sample;
  sample.id = "mine";
  sample.surface = surface;
  return scan(sample, plan, scan_light(plan, test::shipped()));
}

Surface rough_copper(double rms_slope) {
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(3, {0.6, 2.6});
  return cook_torrance(three, rms_slope, n_hat, {}, Normalization::energy_conserving);
}

Surface brushed() {
  return load_sample(test::shipped().find(Catalog::Kind::sample, "steel_brushed"), three).surface;
}

TEST(Scan, OfALambertianSurfaceGivesRhoOverPiWhateverTheApertures) {
  const ArrayXd rho = ArrayXd::LinSpaced(3, 0.2, 0.9);
  ScanPlan plan = plan_of({0.0, 45.0, 80.0, 89.5}, {-89.0, -40.0, 0.0, 88.0}, {0.0, 37.0, 110.0});
  for (const ScanOpening& source : {ScanOpening{}, circle(4.7), rectangle(0.75, 2.5)}) {
    for (const ScanOpening& receptor : {ScanOpening{}, circle(4.7), rectangle(4.0, 6.0)}) {
      plan.source = source;
      plan.receptor = receptor;
      const ScanResult result = scanned(lambertian(three, rho), plan);
      for (Index p = 0; p < result.size(); ++p) {
        const ArrayXd expected = rho / std::numbers::pi;
        EXPECT_LE((result.f_r.col(p) - expected).abs().maxCoeff(), 2.0 * plan.tolerance);
      }
    }
  }
}

TEST(Scan, ByPatchesOfALambertianSurfaceGivesRhoOverPi) {
  ScanPlan plan = plan_of({30.0}, {-20.0, 60.0}, {0.0, 37.0});
  plan.source = plan.receptor = circle(4.7);
  plan.integrator = ScanIntegrator::patches;
  plan.patches = 128;
  const ScanResult result = scanned(lambertian(three, ArrayXd::Constant(3, 0.5)), plan);
  constexpr double rounding = 1e-12;
  EXPECT_LE((result.f_r - 0.5 / std::numbers::pi).abs().maxCoeff(), rounding);
}

TEST(Scan, WithCollimatedArmsGivesTheBrdfItself) {
  ScanPlan plan = plan_of({45.0}, {-70.0, 30.0, 50.0}, {0.0, 20.0});
  plan.source = plan.receptor = ScanOpening{};
  plan.rotation = in_degrees({0.0, 65.0});
  const Surface surface = brushed();
  const ScanResult result = scanned(surface, plan);
  for (Index p = 0; p < result.size(); ++p) {
    const MeasuringGeometry geometry =
        scan_geometry(result.positions[std::size_t(p)], plan.source, plan.receptor);
    const ArrayXd expected =
        surface.brdf(geometry.source.frame().axis, geometry.receptor.frame().axis);
    const double allowed = plan.tolerance * (expected.maxCoeff() + 1e-3);
    EXPECT_LE((result.f_r.col(p) - expected).abs().maxCoeff(), allowed);
  }
}

TEST(Scan, ConvergesToTheBrdfWithTheSquareOfTheApertures) {
  ScanPlan plan = plan_of({40.0}, {35.0, 52.0}, {0.0, 12.0});
  plan.tolerance = 1e-8;
  const Surface surface = rough_copper(0.3);
  std::vector<ArrayXd> deviation;
  for (const double size_deg : {4.0, 2.0, 1.0}) {
    plan.source = plan.receptor = circle(size_deg);
    const ScanResult result = scanned(surface, plan);
    ArrayXd now(result.size());
    for (Index p = 0; p < result.size(); ++p) {
      const MeasuringGeometry geometry =
          scan_geometry(result.positions[std::size_t(p)], plan.source, plan.receptor);
      now(p) = (result.f_r.col(p) -
                surface.brdf(geometry.source.frame().axis, geometry.receptor.frame().axis))(1);
    }
    deviation.push_back(now);
  }
  constexpr double fourth_order = 0.02;  // what the next order leaves at 2 deg
  EXPECT_LE((deviation[0] / deviation[1] - 4.0).abs().maxCoeff(), 4.0 * fourth_order);
  EXPECT_LE((deviation[1] / deviation[2] - 4.0).abs().maxCoeff(), fourth_order);
}

TEST(Scan, IsTheSameWithSourceAndReceptorExchanged) {
  const Surface surface = brushed();
  for (const ScanOpening& opening : {circle(3.0), rectangle(1.0, 4.0)}) {
    for (const double phi_deg : {0.0, 25.0, 160.0}) {
      ScanPlan plan = plan_of({20.0}, {55.0}, {phi_deg});
      plan.source = plan.receptor = opening;
      plan.rotation = in_degrees({15.0});
      const ScanResult there = scanned(surface, plan);
      const ScanPosition back = exchanged(there.positions.front());
      plan.theta_i = {back.theta_i};
      plan.theta_r = {back.theta_r};
      plan.phi_r = {back.phi_r};
      plan.rotation = {back.rotation};
      const ScanResult again = scanned(surface, plan);
      const double allowed = 2.0 * plan.tolerance * (there.f_r.maxCoeff() + 1e-3);
      EXPECT_LE((there.f_r - again.f_r).abs().maxCoeff(), allowed);
    }
  }
}

TEST(Scan, OfThePartsOfAHemisphereAddsUpToItsReflectance) {
  // The faces of the hemicube, each a receptor.
  const Surface surface = rough_copper(0.2);
  const Vector3 omega_i = source_frame(degrees(50)).axis;
  const ApertureIntegrator integrator;
  const ArrayXd weight = ArrayXd::Constant(3, 1.0 / 3.0);
  constexpr double tolerance = 1e-7;
  ArrayXd sum = ArrayXd::Zero(3);
  double projected = 0.0;
  for (const Aperture& face : hemicube_faces()) {
    sum += integrator.reflected(surface, {collimated(omega_i), face}, weight, tolerance).spectral /
           omega_i.z();
    projected += integrator.incident(face);
  }
  const Flux whole = integrator.hemispherical(surface, omega_i, weight, tolerance);
  EXPECT_LE((sum - whole.spectral).abs().maxCoeff(), 10.0 * tolerance);
  EXPECT_NEAR(projected, std::numbers::pi, 1e-9);
}

TEST(Scan, GivesEqualValuesAtSymmetricPositions) {
  ScanPlan plan = plan_of({35.0}, {20.0, 60.0}, {-40.0, 40.0});
  const ScanResult result = scanned(rough_copper(0.2), plan);
  for (const auto& [left, right] : {std::pair{0, 2}, std::pair{1, 3}}) {
    const double allowed = 2.0 * plan.tolerance * (result.f_r.col(left).maxCoeff() + 1e-3);
    EXPECT_LE((result.f_r.col(left) - result.f_r.col(right)).abs().maxCoeff(), allowed);
  }
}

TEST(Scan, SeesTheGrainOfABrushedSurfaceTurn) {
  ScanPlan plan = plan_of({45.0}, {30.0});
  plan.rotation = in_degrees({0.0, 90.0, 180.0});
  const ScanResult result = scanned(brushed(), plan);
  EXPECT_FALSE(result.is_isotropic);
  EXPECT_GT(std::abs(result.f_r(1, 0) / result.f_r(1, 1) - 1.0), 0.1);
  EXPECT_NEAR(result.f_r(1, 0) / result.f_r(1, 2), 1.0, 2.0 * plan.tolerance);
}

TEST(Scan, OfASmoothInterfaceIsItsReflectanceWhereTheReceptorHoldsTheWholeImage) {
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(3, {1.567, 0.0});
  ScanPlan plan = plan_of({30.0}, {30.0, 37.0}, {0.0, 20.0});
  plan.source = {};
  plan.receptor = circle(4.0);
  const Surface glass = smooth(three, n_hat);
  const ScanResult result = scanned(glass, plan);
  const ArrayXd expected = glass.specular_reflectance(std::cos(degrees(30).radians()));
  EXPECT_LE((result.f_r.col(0) * result.omega_r(0) - expected).abs().maxCoeff(), 1e-6);
  EXPECT_EQ(result.f_r.rightCols(3).abs().maxCoeff(), 0.0);
}

TEST(Scan, OfASmoothInterfaceOutOfPlaneSeesTheImageWithinTheReceptor) {
  // The receptor stands 1 deg of azimuth beside the mirror direction: a great circle's
  // sin(30 deg) deg away. Both arms turned with the sample see the same.
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(3, {1.567, 0.0});
  ScanPlan plan = plan_of({30.0}, {30.0}, {1.0});
  plan.source = circle(2.0);
  plan.receptor = circle(2.0);
  plan.tolerance = 1e-7;
  plan.rotation = in_degrees({0.0, 50.0});
  const ScanResult result = scanned(smooth(three, n_hat), plan);
  ScanPlan facing = plan;
  facing.phi_r = in_degrees({0.0});
  const ScanResult whole = scanned(smooth(three, n_hat), facing);
  // Overlap of two equal circles of radius R whose centres are d apart, in units of their area.
  const double d_over_2R = 0.5 * std::sin(degrees(30).radians());
  const double overlap =
      2.0 / std::numbers::pi *
      (std::acos(d_over_2R) - d_over_2R * std::sqrt(1.0 - d_over_2R * d_over_2R));
  constexpr double curvature = 3e-3;  // the sphere is not a plane, and cos i is not constant
  EXPECT_NEAR(result.f_r(1, 0) / whole.f_r(1, 0), overlap, curvature);
  EXPECT_NEAR(result.f_r(1, 1) / result.f_r(1, 0), 1.0, 1e-6);
}

ScanPlan whole_scan(const std::vector<double>& theta) {
  ScanPlan plan = plan_of(theta, theta, {0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0});
  plan.source = plan.receptor = circle(2.0);
  return plan;
}

void expect_same_with_reciprocity(const Surface& surface, ScanPlan plan, double largest_share) {
  plan.reciprocity = UseOfReciprocity::no;
  const ScanResult full = scanned(surface, plan);
  plan.reciprocity = UseOfReciprocity::automatic;
  const ScanResult half = scanned(surface, plan);
  EXPECT_EQ(full.evaluations, full.positions.size());
  EXPECT_LT(double(half.evaluations), largest_share * double(full.evaluations));
  for (Index p = 0; p < full.size(); ++p) {
    const double allowed = 2.0 * plan.tolerance * (full.f_r.col(p).maxCoeff() + 1e-3);
    EXPECT_LE((full.f_r.col(p) - half.f_r.col(p)).abs().maxCoeff(), allowed) << p;
  }
}

TEST(Reciprocity, SparesNearlyHalfOfThePositions) {
  const ScanPlan plan = whole_scan({5.0, 20.0, 35.0, 50.0, 65.0, 80.0});
  expect_same_with_reciprocity(rough_copper(0.2), plan, 0.6);
}

TEST(Reciprocity, NeedsTheSampleTurnedWhereItHasAGrain) {
  ScanPlan plan = whole_scan({20.0, 50.0});
  plan.reciprocity = UseOfReciprocity::automatic;
  plan.phi_r = in_degrees({45.0});
  EXPECT_EQ(scanned(brushed(), plan).evaluations, 4U);
  plan = whole_scan({20.0, 50.0});
  plan.rotation = plan.phi_r;
  constexpr double with_those_that_look_back = 0.54;  // a position that is its own exchanged one
  expect_same_with_reciprocity(brushed(), plan, with_those_that_look_back);
}

TEST(Reciprocity, IsNotUsedBetweenOtherApertures) {
  ScanPlan plan = whole_scan({20.0, 50.0});
  plan.receptor = circle(3.0);
  plan.reciprocity = UseOfReciprocity::automatic;
  const ScanResult result = scanned(rough_copper(0.2), plan);
  EXPECT_EQ(result.evaluations, result.positions.size());
  plan.reciprocity = UseOfReciprocity::yes;
  EXPECT_THROW((void)scanned(rough_copper(0.2), plan), std::invalid_argument);
}

TEST(Scan, LeavesOutWhereTheHeadsWouldCollide) {
  ScanPlan plan = plan_of({30.0}, {-45.0, -40.0, -35.0, -30.0, -20.0, -15.0, 30.0});
  plan.heads_apart = degrees(10);
  const ScanResult result = scanned(lambertian(three, ArrayXd::Ones(3)), plan);
  using enum PositionState;
  EXPECT_THAT(result.state, testing::ElementsAre(measured, measured, blocked, blocked, measured,
                                                 measured, measured));
  EXPECT_TRUE(result.f_r.col(3).isNaN().all());
  EXPECT_EQ(result.evaluations, 5U);
}

TEST(Scan, DoesNotDependOnTheNumberOfThreads) {
  const ScanPlan plan = whole_scan({10.0, 60.0});
  const Surface surface = rough_copper(0.1);
  const ScanResult many = scanned(surface, plan);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE((scanned(surface, plan).f_r == many.f_r).all());
}

TEST(Scan, NeedsAReceptorApertureBeforeASmoothInterface) {
  ScanPlan plan = plan_of({30.0}, {30.0});
  plan.receptor = {};
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(3, {1.5, 0.0});
  EXPECT_THROW((void)scanned(smooth(three, n_hat), plan), std::invalid_argument);
}

TEST(Scan, NeedsPatchesInItsApertures) {
  ScanPlan plan = plan_of({30.0}, {31.0});
  plan.integrator = ScanIntegrator::patches;
  plan.patches = 4;
  EXPECT_THROW((void)scanned(lambertian(three, ArrayXd::Ones(3)), plan), std::invalid_argument);
}

TEST(ScanLight, WeighsByTheEyeWhereItSees) {
  ScanPlan plan;
  EXPECT_TRUE(scan_light(plan, test::shipped()).by_luminance);
  plan.grid = WavelengthGrid(nanometres(310), nanometres(10), 3);
  const ScanLight light = scan_light(plan, test::shipped());
  EXPECT_FALSE(light.by_luminance);
  EXPECT_NEAR(light.weight.sum(), 1.0, 1e-12);
  plan.grid = WavelengthGrid(nanometres(200), nanometres(10), 3);
  EXPECT_THROW((void)scan_light(plan, test::shipped()), InputError);
}

}  // namespace
}  // namespace gonio

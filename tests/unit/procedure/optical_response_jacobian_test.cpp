#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/responses.hpp"

// The derivatives of an OpticalResponse.

namespace gonio {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::few_wavelengths;
using test::glass_reflectance;
using test::is_close;
using test::is_close_relative;
using test::nominal_iso_2813;
using test::nominal_with;
using test::place;
using test::rungs;
using test::shipped_instrument;
using test::three_angles;
using test::tolerance_gu;

/// Derivatives at the nominal parameters by one of them.
VectorXd derivative(const OpticalResponse& response, Index parameter, double step) {
  return response.jacobian(response.nominal(), step * VectorXd::Unit(response.size(), parameter))
      .col(parameter);
}

TEST(JacobianOfIncidence, IsThatOfFresnelsFormulaOnSmoothSamples) {
  constexpr double of_extrapolation = 1e-6;  // relative
  const std::vector<Sample> smooth = rungs({"paint_smooth", "ideal_mirror"});
  for (const std::string& geometry : three_angles) {
    const double theta = std::stod(geometry);
    const OpticalResponse response(shipped_instrument("collimated_iso_2813"), geometry, smooth,
                                   tolerance_gu);
    const VectorXd at = response.as_built();
    const VectorXd found = response.jacobian(at, 0.05 * VectorXd::Unit(8, 0)).col(0);
    const auto closed = [&](const auto& gloss) {
      constexpr double h = 1e-4;
      return (gloss(theta + h) - gloss(theta - h)) / (2 * h);
    };
    const double paint = closed(
        [](double t) { return 100.0 * glass_reflectance(t, 1.5) / glass_reflectance(t, 1.567); });
    const double mirror = closed([](double t) { return 100.0 / glass_reflectance(t, 1.567); });
    EXPECT_TRUE(is_close_relative(found(0), paint, of_extrapolation)) << geometry;
    EXPECT_TRUE(is_close_relative(found(1), mirror, of_extrapolation)) << geometry;
  }
}

// dG/dP = G (D - D_tile), with D the diattenuation of the sample; the figures are those of the
// tile.
TEST(JacobianOfPolarization, IsTheDifferenceOfDiattenuations) {
  constexpr double rounding = 0.0006;
  const std::vector<double> of_the_tile{0.162, 0.991, 0.210};
  const std::vector<Sample> smooth = rungs({"paint_smooth", "ideal_mirror"});
  for (std::size_t g = 0; g < three_angles.size(); ++g) {
    const double cos_theta_i = std::cos(degrees(std::stod(three_angles[g])).radians());
    const auto diattenuation = [&](double n) {
      const PolarisedReflectance rho = fresnel_polarised(cos_theta_i, n);
      return (rho.s - rho.p) / (rho.s + rho.p);
    };
    const OpticalResponse response(shipped_instrument("collimated_iso_2813"), three_angles[g],
                                   smooth, tolerance_gu);
    const VectorXd at = response.as_built();
    const VectorXd gloss_gu = response(at);
    const VectorXd found = response.jacobian(at, 0.01 * VectorXd::Unit(8, 6)).col(6);
    const VectorXd relative = found.cwiseQuotient(gloss_gu);
    EXPECT_TRUE(is_close(-relative(1), of_the_tile[g], rounding)) << three_angles[g];
    EXPECT_TRUE(is_close(relative(1), -diattenuation(1.567), 1e-6)) << three_angles[g];
    EXPECT_TRUE(is_close(relative(0), diattenuation(1.5) - diattenuation(1.567), 1e-6))
        << three_angles[g];
  }
}

// dG/ds = G (lambda_sample - lambda_weight) / 100 nm, with the mean wavelengths of what the sample
// reflects, and of source times responsivity.
TEST(JacobianOfSpectralMismatch, IsTheShiftOfTheMeanWavelength) {
  const ArrayXd rho = ArrayXd::LinSpaced(3, 0.1, 0.7);
  const std::vector<Sample> matt{
      {.file = {}, .id = "grey", .surface = lambertian(few_wavelengths, ArrayXd::Constant(3, 0.5))},
      {.file = {}, .id = "red", .surface = lambertian(few_wavelengths, rho)}};
  const OpticalResponse response(nominal_iso_2813(), "60", matt, tolerance_gu);
  const Glossmeter meter(nominal_iso_2813(), few_wavelengths,
                         std::make_shared<ApertureIntegrator>());
  const ArrayXd x = few_wavelengths.nanometres() / 100.0;
  const double shift =
      (meter.weight() * rho * x).sum() / (meter.weight() * rho).sum() - (meter.weight() * x).sum();
  const VectorXd found = derivative(response, 7, 0.01);
  const VectorXd gloss_gu = response(response.nominal());
  ASSERT_GT(shift, 0.05);
  EXPECT_TRUE(is_close(found(0), 0.0, 10 * tolerance_gu));
  EXPECT_TRUE(is_close(found(1), gloss_gu(1) * shift, 1e-4));
}

// A white diffuser's gloss follows the solid angle of a small receptor, and cosines at its edge.
TEST(JacobianOfTheReceptor, OnAWhiteDiffuserFollowsItsArea) {
  constexpr double of_first_order = 0.01;  // relative
  const std::vector<Sample> white = rungs({"white_diffuser"});
  const OpticalResponse response(nominal_iso_2813(), "60", white, tolerance_gu);
  const double gloss_gu = response(response.nominal())(0);
  EXPECT_TRUE(is_close_relative(derivative(response, 4, 0.05)(0), gloss_gu / 4.4, of_first_order));
  EXPECT_TRUE(is_close_relative(derivative(response, 5, 0.05)(0), gloss_gu / 11.7, of_first_order));
}

// The integrator divides its regions alike at both ends of a step, so that even of an error of
// 1e-4 GU little is left in a difference.
TEST(Jacobian, DoesNotDependOnStepsNorOnTheTolerance) {
  constexpr double agreement = 1e-6;  // GU per deg
  const std::vector<Sample> rough = rungs({"paint_m150", "glass_m050", "glass_m020"});
  const OpticalResponse response(shipped_instrument("triangle_gloss"), "20", rough, 1e-7);
  const VectorXd at = response.as_built();
  const MatrixXd expected = response.jacobian(at, VectorXd::Constant(8, 0.05));
  const auto error = [&](double tolerance, double step) {
    return (response.with_tolerance(tolerance).jacobian(at, VectorXd::Constant(8, step)) - expected)
        .cwiseAbs()
        .maxCoeff();
  };
  EXPECT_LT(error(1e-7, 0.1), agreement);
  EXPECT_LT(error(1e-4, 0.05), agreement);
  EXPECT_LT(error(1e-7, 1e-9), agreement);
}

TEST(Jacobian, IsZeroWhereNoStepIsAskedFor) {
  const std::vector<Sample> rough = rungs({"glass_m050", "paint_m300"});
  const OpticalResponse response(shipped_instrument("triangle_gloss"), "60", rough, tolerance_gu);
  const MatrixXd only = response.jacobian(response.as_built(), 0.05 * VectorXd::Unit(8, 4));
  EXPECT_GT(only.col(4).minCoeff(), 0.0);
  EXPECT_EQ(only.norm(), only.col(4).norm());
}

TEST(Jacobian, IsZeroAtASourceWithoutSize) {
  const std::vector<Sample> rough = rungs({"glass_m050"});
  const OpticalResponse response(shipped_instrument("collimated_iso_2813"), "60", rough,
                                 tolerance_gu);
  const MatrixXd found = response.jacobian(response.as_built(), VectorXd::Constant(8, 0.05));
  EXPECT_EQ(found(0, place(response, SetupQuantity::source_in_plane)), 0.0);
  EXPECT_EQ(found(0, place(response, SetupQuantity::source_perpendicular)), 0.0);
}

// Within 0.02 deg of the receptor's direction the image of the tile is whole; beyond, the receptor
// clips it, and readings rise by percents.
TEST(Jacobian, IsOfTheNearbySideOfAKink) {
  constexpr double agreement = 1e-6;  // GU per deg
  const std::vector<Sample> rough = rungs({"glass_m100"});
  const OpticalResponse response(nominal_iso_2813(), "20", rough, 1e-8);
  const VectorXd at = nominal_with(
      response, {{SetupQuantity::source_in_plane, 1.76}, {SetupQuantity::theta_r, 20.005}});
  const Index theta_r = place(response, SetupQuantity::theta_r);
  const auto difference = [&](double h) {
    const VectorXd step = h * VectorXd::Unit(response.size(), theta_r);
    return (response(at + step)(0) - response(at - step)(0)) / (2 * h);
  };
  const double within = difference(0.001);
  EXPECT_GT(std::abs(difference(0.05) - within), 0.05);
  const double found =
      response.jacobian(at, 0.05 * VectorXd::Unit(response.size(), theta_r))(0, theta_r);
  EXPECT_TRUE(is_close(found, within, agreement));
}

}  // namespace
}  // namespace gonio

#include "emulator/integration/measured_flux.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "emulator/integration/patch_integrator.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/glossmeter.hpp"
#include "tests/unit/model_brdf.hpp"

namespace gonio {
namespace {

using test::collimated_glossmeter;
using test::constant_index;
using test::glossmeter;
using test::is_close;
using test::ModelBrdf;
using test::one_wavelength;
using test::SampledModelBrdf;
using test::whole_weight;

Surface rough(double m) { return cook_torrance(one_wavelength, m, constant_index(1.567)); }
Surface as_measured(const Surface& surface, Angle step = degrees(1)) {
  return test::measured(std::make_shared<ModelBrdf>(surface, step), one_wavelength);
}

TEST(MeasuredFlux, OfALambertianTableIsThatOfTheModel) {
  constexpr double rounding = 1e-12;  // relative
  const Surface model = lambertian(one_wavelength, Eigen::ArrayXd::Constant(1, 0.6));
  for (const double theta_deg : {20.0, 60.0, 85.0}) {
    const double expected = test::gloss_gu(model, glossmeter(theta_deg));
    EXPECT_TRUE(is_close(test::gloss_gu(as_measured(model), glossmeter(theta_deg)), expected,
                         1e-6 + rounding))
        << theta_deg;
  }
}

TEST(MeasuredFlux, OfAModelIsThatOfTheModelToItsStatedError) {
  for (const double m : {0.02, 0.05, 0.2}) {
    for (const double theta_deg : {20.0, 60.0, 85.0}) {
      const MeasuringGeometry geometry = glossmeter(theta_deg);
      const double standard = test::standard_flux(geometry);
      const double tolerance = 1e-6 * standard;
      const Flux flux =
          ApertureIntegrator().reflected(as_measured(rough(m)), geometry, whole_weight, tolerance);
      const double expected = test::flux_of(rough(m), geometry, 1e-9 * standard);
      EXPECT_TRUE(is_close(flux.spectral(0), expected, flux.error)) << m << " at " << theta_deg;
      // Across the plane the lobe at 85 deg is narrower than the step by which panels are chosen.
      const double smooth_enough = theta_deg > 80.0 ? 3e-3 : 1e-4;
      EXPECT_LT(flux.error, smooth_enough * standard) << m << " at " << theta_deg;
    }
  }
}

TEST(MeasuredFlux, StatesAnErrorThatCoversKinks) {
  const MeasuringGeometry geometry = collimated_glossmeter(60.0);
  const double standard = test::standard_flux(geometry);
  const Surface table =
      test::measured(std::make_shared<SampledModelBrdf>(rough(0.05), degrees(1)), one_wavelength);
  const Flux flux = ApertureIntegrator().reflected(table, geometry, whole_weight, 1e-9 * standard);
  // The middles of a fine lattice: kinks do not harm them more than anything else.
  constexpr int n = 1000;
  double expected = 0.0;
  const Aperture& receptor = geometry.receptor;
  const double du = (receptor.u_high() - receptor.u_low()) / n;
  const double dv = (receptor.v_high() - receptor.v_low()) / n;
  DirectionBatch omega;
  omega.resize(n);
  Eigen::ArrayXXd f_r(n, 1);
  for (int i = 0; i < n; ++i) {
    Eigen::ArrayXd factor(n);
    for (int j = 0; j < n; ++j) {
      const double u = receptor.u_low() + (i + 0.5) * du;
      const double v = receptor.v_low() + (j + 0.5) * dv;
      const Vector3 direction = receptor.frame().direction(u, v);
      omega.x(j) = direction.x();
      omega.y(j) = direction.y();
      omega.z(j) = direction.z();
      factor(j) = direction.z() * du * dv / std::pow(1.0 + u * u + v * v, 1.5);
    }
    table.measured[0].brdf->evaluate(geometry.source.frame().axis, omega, f_r);
    expected += (f_r.col(0) * factor).sum();
  }
  expected *= geometry.source.frame().axis.z();
  EXPECT_TRUE(is_close(flux.spectral(0), expected, flux.error + 1e-6 * expected));
  EXPECT_LT(flux.error, 5e-4 * flux.spectral(0));
}

TEST(MeasuredFlux, IntoTheHemisphereIsThatOfTheModel) {
  constexpr double tolerance = 1e-4;
  const Vector3 omega_i = source_frame(degrees(40)).axis;
  const auto of = [&](const Surface& surface) {
    return ApertureIntegrator().hemispherical(surface, omega_i, whole_weight, tolerance);
  };
  const Flux flux = of(as_measured(rough(0.2)));
  EXPECT_TRUE(is_close(flux.spectral(0), of(rough(0.2)).spectral(0), tolerance + flux.error));
}

TEST(MeasuredFlux, ByPatchesIsThatOfTheModelByPatches) {
  constexpr double series = 1e-8;  // what colours are expanded to
  constexpr Eigen::Index resolution = 256;
  const PatchIntegrator patches(resolution);
  for (const double theta_deg : {20.0, 60.0, 85.0}) {
    const MeasuringGeometry geometry = glossmeter(theta_deg);
    const auto flux = [&](const Surface& surface) {
      return patches.reflected(surface, geometry, whole_weight, 1.0).spectral(0);
    };
    const double expected = flux(rough(0.1));
    EXPECT_TRUE(is_close(flux(as_measured(rough(0.1))), expected, series + 1e-6 * expected));
  }
}

TEST(MeasuredFlux, OfAMixtureIsWeighted) {
  const MeasuringGeometry geometry = glossmeter(60.0);
  const Surface table = as_measured(rough(0.1));
  const double whole = test::gloss_gu(table, geometry, 1e-3);
  const double part = test::gloss_gu(mixture({table, table}, {0.25, 0.5}), geometry, 1e-3);
  EXPECT_TRUE(is_close(part, 0.75 * whole, 4e-3));  // both errors, and the shares of the tolerance
}

}  // namespace
}  // namespace gonio

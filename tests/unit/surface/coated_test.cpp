#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/gauss_rule.hpp"
#include "tests/unit/surface/every_model.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using std::numbers::pi;
using test::is_close;
using test::is_close_relative;
using test::one_wavelength;

double cosine(double theta_deg) { return std::cos(degrees(theta_deg).radians()); }

/// Reflectance of the interface for diffuse light from inside, by quadrature from the inside:
/// int_0^1 2 F(c) c dc with F the reflectance from n to 1, total beyond the critical angle.
double internal_diffuse_reflectance(double n) {
  const double critical = std::sqrt(1.0 - 1.0 / (n * n));
  const test::GaussRule rule(60);
  // cos = critical + s^2 takes away the square root at the critical angle.
  const double below = rule.integral(0.0, std::sqrt(1.0 - critical), [&](double s) {
    const double c = critical + s * s;
    return 2.0 * c * fresnel_reflectance(std::min(c, 1.0), 1.0 / n) * 2.0 * s;
  });
  return critical * critical + below;
}

/// Saunderson's diffuse part by its series of reflections between base and interface.
double saunderson_brdf(double base, double n, double cos_i, double cos_r) {
  const double inside = internal_diffuse_reflectance(n);
  double rays = 0.0;
  double ray = base;
  for (int k = 0; k < 3000 && ray > 1e-18; ++k) {
    rays += ray;
    ray *= base * inside;
  }
  return (1.0 - fresnel_reflectance(cos_i, n)) * rays * (1.0 - fresnel_reflectance(cos_r, n)) /
         (pi * n * n);
}

TEST(DiffuseFresnelReflectance, AgreesWithGaussQuadratureFromBothSides) {
  constexpr double quadrature = 1e-11;
  const test::GaussRule rule(60);
  for (const double n : {1.1, 1.33, 1.5, 1.567, 2.0, 3.0}) {
    const double outside =
        rule.integral(0.0, 1.0, [&](double c) { return 2.0 * c * fresnel_reflectance(c, n); });
    EXPECT_TRUE(is_close(diffuse_fresnel_reflectance(n), outside, quadrature)) << n;
    EXPECT_TRUE(is_close(1.0 - (1.0 - diffuse_fresnel_reflectance(n)) / (n * n),
                         internal_diffuse_reflectance(n), quadrature))
        << n;
  }
}

TEST(Coated, EqualsSaundersonsSeriesOfReflections) {
  constexpr double series = 1e-10;
  for (const double n : {1.33, 1.5, 1.8}) {
    for (const double base : {0.05, 0.5, 0.9}) {
      const Surface surface =
          coated(one_wavelength, ArrayXd::Constant(1, base), ArrayXd::Constant(1, n), 0.0);
      for (const double theta_i : {0.0, 45.0, 80.0}) {
        for (const double theta_r : {10.0, 60.0, 85.0}) {
          const double got = surface.brdf(source_frame(degrees(theta_i)).axis,
                                          receptor_frame(degrees(theta_r)).axis)(0);
          EXPECT_TRUE(is_close_relative(
              got, saunderson_brdf(base, n, cosine(theta_i), cosine(theta_r)), series))
              << "n = " << n << ", base " << base << ", " << theta_i << " to " << theta_r;
        }
      }
    }
  }
}

TEST(Coated, ReflectsInTheMirrorDirectionLikeItsInterface) {
  const Surface surface =
      coated(one_wavelength, ArrayXd::Constant(1, 0.5), ArrayXd::Constant(1, 1.5), 0.0);
  for (const double theta : {0.0, 20.0, 85.0}) {
    EXPECT_EQ(surface.specular_reflectance(cosine(theta))(0),
              fresnel_reflectance(cosine(theta), 1.5));
  }
}

TEST(Coated, OfABlackBaseIsItsInterfaceAlone) {
  const ArrayXd black = ArrayXd::Zero(1);
  const ArrayXd n = ArrayXd::Constant(1, 1.567);
  const Vector3 i = source_frame(degrees(40)).axis;
  const Vector3 r = receptor_frame(degrees(50)).axis;
  EXPECT_EQ(coated(one_wavelength, black, n, 0.0).brdf(i, r)(0), 0.0);
  EXPECT_EQ(coated(one_wavelength, black, n, 0.1).brdf(i, r)(0),
            cook_torrance(one_wavelength, 0.1, test::constant_index(1.567)).brdf(i, r)(0));
}

TEST(Coated, TendsToItsSmoothFormWithTheSlopeOfTheInterface) {
  // Far from grazing; the scale of the diffuse part falls short of 1 by what shadowing takes.
  constexpr double fitting = 5e-3;
  const ArrayXd white = ArrayXd::Ones(1);
  const ArrayXd n = ArrayXd::Constant(1, 1.5);
  for (const double theta : {0.0, 20.0, 60.0}) {
    const auto rough =
        test::hemispherical_reflectance(coated(one_wavelength, white, n, 1e-3), theta, 1e-8);
    EXPECT_TRUE(is_close(rough.value, 1.0, fitting)) << theta;
  }
}

}  // namespace
}  // namespace gonio

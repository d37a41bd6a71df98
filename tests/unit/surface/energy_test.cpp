#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/surface/every_model.hpp"

// [Mihalik] eq. (7): no surface reflects more than it receives, at any incidence. Each model has
// the largest reflectance it can have: an ideal metal, a white base, amplitudes of sum 1.

namespace gonio {
namespace {

using Eigen::ArrayXd;
using test::constant_index;
using test::ideal_metal;
using test::is_close;
using test::one_wavelength;
using test::Reflectance;
using test::whole_weight;

constexpr double rounding = 1e-13;
constexpr double tolerance = 1e-6;  // of the reflectance; the error reported is allowed for
constexpr std::array<double, 15> incidences_deg{0,  1,  5,  10, 20, 30, 45,  60,
                                                70, 75, 80, 85, 88, 89, 89.9};
const std::vector<double> widths = {0.0005, 0.002, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0};

/// The largest reflectance over all incidences, less the error reported.
double largest_reflectance(const Surface& surface, const std::string& name) {
  double largest = 0.0;
  for (const double theta_i : incidences_deg) {
    const Reflectance reflectance = test::hemispherical_reflectance(surface, theta_i, tolerance);
    EXPECT_LE(reflectance.value - reflectance.error, 1.0 + rounding)
        << name << " at " << theta_i << " deg: reflects " << reflectance.value << " +- "
        << reflectance.error << ", more than 1";
    EXPECT_LE(reflectance.error, tolerance) << name << " at " << theta_i << " deg";
    largest = std::max(largest, reflectance.value - reflectance.error);
  }
  return largest;
}

TEST(Energy, IsNotMadeByCookTorrance) {
  std::vector<double> slopes = widths;
  slopes.insert(slopes.end(), {2.0, 5.0});
  for (const double m : slopes) {
    const auto n_hat = constant_index(ideal_metal);
    EXPECT_GT(
        largest_reflectance(cook_torrance(one_wavelength, m, n_hat), "m = " + std::to_string(m)),
        m < 0.2 ? 0.99 : 0.2);
  }
}

TEST(Energy, IsNotMadeByGgx) {
  for (const Masking masking : {Masking::height_correlated, Masking::separable}) {
    for (const double alpha : widths) {
      const Surface surface = ggx(one_wavelength, alpha, constant_index(ideal_metal), {}, masking);
      const std::string name =
          masking == Masking::separable ? "separable, " : "height_correlated, ";
      EXPECT_GT(largest_reflectance(surface, name + "alpha = " + std::to_string(alpha)),
                alpha < 0.2 ? 0.98 : 0.5);
    }
  }
}

TEST(Energy, IsNotMadeByWard) {
  for (const double alpha_x : widths) {
    for (const double ratio : {0.1, 1.0, 10.0}) {
      const double alpha_y = std::min(ratio * alpha_x, 1.0);
      EXPECT_GT(largest_reflectance(
                    ward(one_wavelength, alpha_x, alpha_y, {}),
                    "alpha = " + std::to_string(alpha_x) + ", " + std::to_string(alpha_y)),
                std::max(alpha_x, alpha_y) < 0.2 ? 0.98 : 0.3);
    }
  }
}

TEST(Energy, IsNotMadeByCoherentRoughness) {
  for (const double sigma_nm : {1.0, 10.0, 30.0, 100.0, 300.0, 1000.0}) {
    for (const double length_um : {0.3, 1.0, 3.0, 10.0, 100.0}) {
      const Surface surface =
          coherent_roughness(one_wavelength, nanometres(sigma_nm), micrometres(length_um),
                             constant_index(ideal_metal));
      EXPECT_GT(largest_reflectance(surface, "sigma = " + std::to_string(sigma_nm) +
                                                 " nm, T = " + std::to_string(length_um) + " um"),
                0.2);
    }
  }
}

TEST(Energy, IsNotMadeByACoatedWhiteBase) {
  for (const double n : {1.01, 1.33, 1.5, 2.0, 3.0}) {
    for (const double m : {0.0, 0.001, 0.02, 0.1, 0.3, 0.6, 1.0}) {
      const Surface surface = coated(one_wavelength, whole_weight, ArrayXd::Constant(1, n), m);
      EXPECT_GT(
          largest_reflectance(surface, "n = " + std::to_string(n) + ", m = " + std::to_string(m)),
          0.9);
    }
  }
}

TEST(Energy, IsNotMadeByASpecularLobeOverADiffuseOne) {
  for (const double specular : {0.0, 0.3, 0.8, 1.0}) {
    const Amplitudes amplitudes{.specular = specular,
                                .diffuse = ArrayXd::Constant(1, 1.0 - specular)};
    const auto n_hat = constant_index(ideal_metal);
    for (const double m : {0.01, 0.1, 0.5}) {
      largest_reflectance(cook_torrance(one_wavelength, m, n_hat, amplitudes), "cook_torrance");
      largest_reflectance(ggx(one_wavelength, m, n_hat, amplitudes), "ggx");
      largest_reflectance(ward(one_wavelength, m, m, amplitudes), "ward");
    }
  }
}

TEST(WhiteFurnace, LosesNothingOfALambertianSurface) {
  const Surface white = lambertian(one_wavelength, whole_weight);
  for (const double theta_i : incidences_deg) {
    const Reflectance reflectance = test::hemispherical_reflectance(white, theta_i, 1e-12);
    EXPECT_TRUE(is_close(reflectance.value, 1.0, 1e-12)) << theta_i;
  }
}

TEST(WhiteFurnace, LosesNothingOfASmoothlyCoatedWhiteBase) {
  for (const double n : {1.01, 1.33, 1.5, 2.0, 3.0}) {
    const Surface white = coated(one_wavelength, whole_weight, ArrayXd::Constant(1, n), 0.0);
    for (const double theta_i : incidences_deg) {
      const Reflectance reflectance = test::hemispherical_reflectance(white, theta_i, 1e-10);
      EXPECT_TRUE(is_close(reflectance.value, 1.0, 1e-10 + rounding))
          << "n = " << n << " at " << theta_i << " deg";
    }
  }
}

TEST(WhiteFurnace, LosesNothingOfNarrowLobes) {
  // What shadowing takes vanishes with the width: m^2 / cos^2 theta_i far from grazing.
  constexpr double width = 1e-3;
  constexpr double lost = 20.0 * width * width;
  const auto n_hat = constant_index(ideal_metal);
  for (const double theta_i : {0.0, 20.0, 45.0, 60.0}) {
    for (const Surface& surface :
         {cook_torrance(one_wavelength, width, n_hat), ggx(one_wavelength, width, n_hat),
          ggx(one_wavelength, width, n_hat, {}, Masking::separable),
          ward(one_wavelength, width, width, {})}) {
      const Reflectance reflectance = test::hemispherical_reflectance(surface, theta_i, 1e-8);
      EXPECT_TRUE(is_close(reflectance.value, 1.0, lost)) << theta_i;
    }
  }
}

TEST(CookTorranceAsPrinted, IsFourTimesTheEnergyConservingForm) {
  constexpr double relative = 1e-15;
  const auto n_hat = constant_index(1.567);
  const Surface conserving = cook_torrance(one_wavelength, 0.1, n_hat);
  const Surface printed = cook_torrance(one_wavelength, 0.1, n_hat, {}, Normalization::as_printed);
  std::mt19937 random(20110905);
  for (int k = 0; k < 200; ++k) {
    const Vector3 i = test::random_direction(random);
    const Vector3 r = test::random_direction(random);
    EXPECT_TRUE(
        test::is_close_relative(printed.brdf(i, r)(0), 4.0 * conserving.brdf(i, r)(0), relative));
  }
}

TEST(CookTorranceAsPrinted, ReflectsFourTimesFresnelInTheSmoothLimitAndSoBreaksEq7) {
  for (const double theta_i : {0.0, 20.0, 60.0}) {
    const double rho = fresnel_reflectance(std::cos(degrees(theta_i).radians()), 1.567);
    for (const double m : {1e-2, 1e-3}) {
      const Surface glass =
          cook_torrance(one_wavelength, m, constant_index(1.567), {}, Normalization::as_printed);
      const Reflectance reflectance = test::hemispherical_reflectance(glass, theta_i, 1e-9);
      EXPECT_TRUE(is_close(reflectance.value, 4.0 * rho, 20.0 * m * m)) << theta_i;
    }
    const Surface metal = cook_torrance(one_wavelength, 1e-3, constant_index(ideal_metal), {},
                                        Normalization::as_printed);
    EXPECT_TRUE(is_close(test::hemispherical_reflectance(metal, theta_i, 1e-6).value, 4.0, 1e-4))
        << theta_i;
  }
}

}  // namespace
}  // namespace gonio

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/surface/every_model.hpp"

namespace gonio {
namespace {

using std::numbers::pi;
using test::constant_index;
using test::is_close;
using test::is_close_relative;
using test::one_wavelength;

constexpr double lambda_nm = 555.0;  // of one_wavelength
const Eigen::ArrayXcd glass = constant_index(1.567);

double cosine(double theta_deg) { return std::cos(degrees(theta_deg).radians()); }

/// rms slope m of the scattered lobe where d is the angle of incidence on the facets: f_r at a
/// facet along the normal against f_r at one tilted by a across the plane of both directions,
/// where no groove hides it.
double scattered_rms_slope(const Surface& surface, double theta_d_deg) {
  constexpr double tan_a = 1e-3;
  const double c = cosine(theta_d_deg);
  const double s = std::sin(degrees(theta_d_deg).radians());
  const auto without_cosines = [&](const Vector3& h) {
    const Vector3 i = c * h - s * Vector3::UnitX();
    const Vector3 r = c * h + s * Vector3::UnitX();
    return surface.lobes.at(0).brdf(i, r)(0) * i.z() * r.z() * std::pow(h.z(), 4);
  };
  const double drop = std::log(without_cosines(Vector3::UnitZ()) /
                               without_cosines(Vector3(0.0, tan_a, 1.0).normalized()));
  return tan_a / std::sqrt(drop);
}

TEST(CoherentRoughness, KeepsInTheMirrorDirectionWhatDaviesSays) {
  // exp(-(4 pi sigma cos theta / lambda)^2) at 555 nm, at 20, 60 and 85 deg; six decimals.
  struct Row {
    double sigma_nm;
    std::array<double, 3> factor;
  };
  constexpr double printed = 0.5e-6 * (1 + 1e-6);
  constexpr std::array<double, 3> angles_deg{20.0, 60.0, 85.0};
  for (const Row& row : {Row{10, {.955740, .987265, .999611}}, Row{20, {.834370, .950025, .998444}},
                         Row{50, {.322473, .725847, .990312}},
                         Row{100, {.010814, .277575, .961806}}, Row{200, {0, .005936, .855755}}}) {
    const Surface surface =
        coherent_roughness(one_wavelength, nanometres(row.sigma_nm), micrometres(20), glass);
    for (std::size_t i = 0; i < 3; ++i) {
      const double c = cosine(angles_deg[i]);
      EXPECT_TRUE(is_close(surface.specular_reflectance(c)(0) / fresnel_reflectance(c, 1.567),
                           row.factor[i], printed))
          << "sigma = " << row.sigma_nm << " nm at " << angles_deg[i] << " deg";
    }
  }
}

TEST(CoherentRoughness, OfNoHeightIsSmooth) {
  const Surface surface = coherent_roughness(one_wavelength, nanometres(0), micrometres(20), glass);
  EXPECT_TRUE(surface.lobes.empty());
  EXPECT_EQ(surface.specular_reflectance(0.5)(0), fresnel_reflectance(0.5, 1.567));
}

TEST(CoherentRoughness, TendsToSmoothWithItsHeight) {
  // What leaves the mirror direction is at most (4 pi sigma / lambda)^2 of the gloss.
  for (const double theta : {20.0, 60.0, 85.0}) {
    for (const double sigma_nm : {1.0, 0.1, 0.01}) {
      const double lost = std::pow(4.0 * pi * sigma_nm / lambda_nm * cosine(theta), 2);
      const double gloss = test::gloss_gu(
          coherent_roughness(one_wavelength, nanometres(sigma_nm), micrometres(20), glass),
          test::glossmeter(theta));
      EXPECT_TRUE(is_close(gloss, 100.0, 110.0 * lost + 1e-6))
          << theta << " deg, " << sigma_nm << " nm";
    }
  }
}

TEST(CoherentRoughness, ScattersWhatIsNotCoherentWhereTheLobeIsNarrow) {
  // lambda / (2 pi T) and 2 sigma / T are below 1e-3, and so F, G and the share that is scattered
  // change over the lobe by no more than that.
  constexpr double change_over_lobe = 2e-3;
  for (const double theta : {0.0, 20.0, 45.0, 60.0}) {
    for (const double sigma_nm : {10.0, 50.0, 100.0, 300.0}) {
      const Surface surface =
          coherent_roughness(one_wavelength, nanometres(sigma_nm), micrometres(1000), glass);
      const double rho = fresnel_reflectance(cosine(theta), 1.567);
      const auto whole = test::hemispherical_reflectance(surface, theta, 1e-8);
      EXPECT_TRUE(is_close_relative(whole.value, rho, change_over_lobe))
          << sigma_nm << " nm at " << theta << " deg";
      EXPECT_LT(surface.specular_reflectance(cosine(theta))(0), 0.99 * rho) << theta;
    }
  }
}

TEST(CoherentRoughness, ScattersBySlopesWhereItIsRough) {
  // g is above 100: m is 2 sigma / T to exp(-100).
  constexpr double of_the_finite_tilt = 1e-3;  // and of the weakening that changes with it
  for (const double theta : {0.0, 20.0, 60.0}) {
    const Surface surface =
        coherent_roughness(one_wavelength, nanometres(1000), micrometres(20), glass);
    EXPECT_TRUE(is_close_relative(scattered_rms_slope(surface, theta), 2.0 * 1.0 / 20.0,
                                  of_the_finite_tilt))
        << theta;
  }
}

TEST(CoherentRoughness, DiffractsByTheCorrelationLengthWhereItIsSmooth) {
  // g is below 6e-4, and m is lambda / (2 pi T cos theta) to g / 4.
  constexpr double half_of_g = 3e-4;
  for (const double theta : {0.0, 20.0, 60.0}) {
    for (const double length_um : {5.0, 20.0}) {
      const Surface surface =
          coherent_roughness(one_wavelength, nanometres(1), micrometres(length_um), glass);
      const double expected = 1e-3 * lambda_nm / (2.0 * pi * length_um * cosine(theta));
      EXPECT_TRUE(is_close_relative(scattered_rms_slope(surface, theta), expected, half_of_g))
          << theta << " deg, T = " << length_um << " um";
    }
  }
}

TEST(CoherentRoughness, KeepsMoreOfRedThanOfBlue) {
  const Surface surface = coherent_roughness(test::two_wavelengths, nanometres(50), micrometres(20),
                                             constant_index(1.567, test::two_wavelengths));
  const Eigen::ArrayXd coherent = surface.specular_reflectance(cosine(20));
  EXPECT_GT(coherent(1), 1.5 * coherent(0));
}

}  // namespace
}  // namespace gonio

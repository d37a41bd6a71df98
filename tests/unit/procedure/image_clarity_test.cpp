#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "emulator/procedure/profile.hpp"
#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using test::is_close;

constexpr double distance_mm = 100.0;

/// Elements of equal steps, over +-reach, of light that lies Gaussian in the plane of the comb.
Profile gaussian(double sigma_mm, double step_mm, double reach_mm) {
  const auto count = Eigen::Index(std::round(2.0 * reach_mm / step_mm));
  Profile profile{.edge_rad = Eigen::ArrayXd(count + 1), .flux = Eigen::ArrayXd(count)};
  const auto below = [&](double x) { return 0.5 * std::erfc(-x / (sigma_mm * std::sqrt(2.0))); };
  for (Eigen::Index k = 0; k <= count; ++k) {
    const double x = -reach_mm + double(k) * step_mm;
    profile.edge_rad(k) = std::atan(x / distance_mm);
    if (k > 0) {
      profile.flux(k - 1) = below(x) - below(x - step_mm);
    }
  }
  return profile;
}

/// The Fourier series of a square wave of period p, each harmonic weakened by the Gaussian:
/// C / 100 = 4/pi sum over odd k of (-1)^((k-1)/2) / k exp(-2 pi^2 k^2 sigma^2 / p^2).
double closed_form(double sigma_mm, double comb_mm) {
  const double ratio = std::numbers::pi * sigma_mm / (2.0 * comb_mm);
  double sum = 0.0;
  for (int k = 1, sign = 1; k < 2000; k += 2, sign = -sign) {
    sum += double(sign) / k * std::exp(-2.0 * ratio * ratio * k * k);
  }
  return 400.0 / std::numbers::pi * sum;
}

TEST(ImageClarity, OfAGaussianIsThatOfItsFourierSeries) {
  constexpr double per_cent = 0.1;  // 1e-3 of full scale
  for (const double sigma_mm : {0.02, 0.05, 0.1, 0.3, 0.7}) {
    const Profile profile = gaussian(sigma_mm, 0.004, 12.0);
    for (const double comb_mm : {0.125, 0.25, 0.5, 1.0, 2.0}) {
      EXPECT_TRUE(is_close(image_clarity(profile, comb_mm, distance_mm).value(),
                           closed_form(sigma_mm, comb_mm), per_cent))
          << sigma_mm << " mm behind " << comb_mm << " mm";
    }
  }
}

TEST(ImageClarity, Is100OfALineAnd0OfEvenLight) {
  constexpr double rounding = 1e-9;
  const Profile line = gaussian(1e-4, 0.01, 5.0);
  Profile even = line;
  const Eigen::ArrayXd place = even.edge_rad.tan();
  even.flux = place.tail(even.flux.size()) - place.head(even.flux.size());
  for (const double comb_mm : {0.125, 0.25, 0.5, 1.0, 2.0}) {
    EXPECT_NEAR(image_clarity(line, comb_mm, distance_mm).value(), 100.0, rounding) << comb_mm;
    EXPECT_NEAR(image_clarity(even, comb_mm, distance_mm).value(), 0.0, rounding) << comb_mm;
  }
}

TEST(ImageClarity, DependsOnTheAngleOfABandAlone) {
  constexpr double rounding = 1e-9;
  const Profile profile = gaussian(0.2, 0.01, 10.0);
  EXPECT_NEAR(image_clarity(profile, 0.5, distance_mm).value(),
              image_clarity(profile, 1.0, 2.0 * distance_mm).value(), rounding);
}

TEST(ImageClarity, IsNotDefinedWithoutAPeriodOrWithoutLight) {
  Profile profile = gaussian(0.2, 0.01, 1.0);
  EXPECT_FALSE(image_clarity(profile, 2.0, distance_mm));
  profile.flux.setZero();
  EXPECT_FALSE(image_clarity(profile, 0.125, distance_mm));
}

}  // namespace
}  // namespace gonio

#include "emulator/optics/fresnel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "tests/unit/csv_rows.hpp"

namespace gonio {
namespace {

using Complex = std::complex<double>;

const std::vector<Complex> materials = {
    1.33, 1.5, 1.567, 1.8, 2.6, {0.6, 2.6}, {0.05, 4.2}, {3.3, 0.22}, {2.3, 3.1}, {1.5, 1e-6}, 0.7};

double cosine(double angle_deg) { return std::cos(degrees(angle_deg).radians()); }

TEST(FresnelReflectance, EqualsTheClosedFormAtNormalIncidence) {
  constexpr double rounding = 1e-14;
  for (const Complex n_hat : materials) {
    const double expected = std::norm((n_hat - 1.0) / (n_hat + 1.0));
    EXPECT_NEAR(fresnel_reflectance(1.0, n_hat), expected, rounding) << n_hat;
  }
}

TEST(FresnelReflectance, IsOneAtGrazingIncidence) {
  for (const Complex n_hat : materials) {
    EXPECT_DOUBLE_EQ(fresnel_reflectance(0.0, n_hat), 1.0) << n_hat;
  }
}

TEST(FresnelReflectance, EqualsTheReferenceTableOfDielectrics) {
  constexpr double printed = 0.5e-7 * (1 + 1e-6);  // seven decimals
  const auto rows = test::csv_rows(GONIO_SOURCE_DIR "/fixtures/reference/fresnel_gloss_vs_n.csv");
  for (const auto& row : rows) {
    const double n = row.number("n");
    for (const std::string angle : {"20", "45", "60", "75", "85"}) {
      EXPECT_NEAR(fresnel_reflectance(cosine(std::stod(angle)), n), row.number("R" + angle),
                  printed)
          << "n = " << n << " at " << angle << " deg";
    }
    for (const std::string angle : {"20", "60", "85"}) {
      const PolarisedReflectance rho = fresnel_polarised(cosine(std::stod(angle)), n);
      EXPECT_NEAR(rho.s, row.number("Rs" + angle), printed) << "n = " << n << ", " << angle;
      EXPECT_NEAR(rho.p, row.number("Rp" + angle), printed) << "n = " << n << ", " << angle;
    }
  }
}

TEST(FresnelPolarised, IsTheSquareOfTheAmplitudesAndLiesBetween0And1) {
  constexpr int draws = 20'000;
  constexpr double rounding = 1e-12;  // of a quotient of sums that cancel to about 1e-3
  std::mt19937 random(19930512);
  std::uniform_real_distribution<double> cos_theta_i(0.0, 1.0);
  std::uniform_real_distribution<double> n(0.05, 5.0);
  std::uniform_real_distribution<double> k(0.0, 8.0);
  for (int i = 0; i < draws; ++i) {
    const double c = cos_theta_i(random);
    const Complex n_hat(n(random), i % 3 == 0 ? 0.0 : k(random));
    const PolarisedReflectance rho = fresnel_polarised(c, n_hat);
    const FresnelAmplitudes r = fresnel_amplitudes(c, n_hat);
    ASSERT_NEAR(rho.s, std::norm(r.s), rounding) << n_hat << ", cos = " << c;
    ASSERT_NEAR(rho.p, std::norm(r.p), rounding) << n_hat << ", cos = " << c;
    ASSERT_GE(rho.s, 0.0) << n_hat << ", cos = " << c;
    ASSERT_GE(rho.p, -1e-15) << n_hat << ", cos = " << c;
    ASSERT_LE(rho.s, 1.0 + 1e-14) << n_hat << ", cos = " << c;
    ASSERT_LE(rho.p, rho.s + 1e-14) << n_hat << ", cos = " << c;
  }
}

TEST(FresnelPolarised, LosesParallelLightAtBrewstersAngle) {
  constexpr double rounding = 1e-15;
  for (const double n : {1.33, 1.5, 1.567, 2.6}) {
    const double cos_brewster = 1.0 / std::sqrt(1.0 + n * n);  // tan theta = n
    EXPECT_NEAR(fresnel_polarised(cos_brewster, n).p, 0.0, rounding) << n;
    EXPECT_GT(fresnel_polarised(cos_brewster, n).s, 0.01) << n;
  }
}

TEST(FresnelPolarised, IsTotalBeyondTheCriticalAngle) {
  constexpr double rounding = 1e-14;
  const double n = 1.0 / 1.5;
  for (const double angle_deg : {42.0, 45.0, 60.0, 89.0}) {  // sin theta > n from 41.8 deg on
    EXPECT_NEAR(fresnel_polarised(cosine(angle_deg), n).s, 1.0, rounding) << angle_deg;
    EXPECT_NEAR(fresnel_polarised(cosine(angle_deg), n).p, 1.0, rounding) << angle_deg;
  }
  EXPECT_LT(fresnel_reflectance(cosine(41.0), n), 0.5);
}

TEST(FresnelReflectance, GrowsWithTheAngleOnADielectricAboveAir) {
  for (const double n : {1.33, 1.5, 1.567, 1.8}) {
    double before = fresnel_reflectance(1.0, n);
    for (int angle_deg = 1; angle_deg <= 90; ++angle_deg) {
      const double rho = fresnel_reflectance(std::max(cosine(angle_deg), 0.0), n);
      EXPECT_GT(rho, before) << "n = " << n << " at " << angle_deg << " deg";
      before = rho;
    }
  }
}

TEST(FresnelReflectance, IsTheMeanOfBothPolarisationsAndTheSameInABatch) {
  for (const double angle_deg : {0.0, 20.0, 60.0, 85.0}) {
    Eigen::ArrayXcd n_hat(Eigen::Index(materials.size()));
    std::copy(materials.begin(), materials.end(), n_hat.begin());
    const Eigen::ArrayXd batch = fresnel_reflectance(cosine(angle_deg), n_hat);
    ASSERT_EQ(batch.size(), n_hat.size());
    for (Eigen::Index i = 0; i < n_hat.size(); ++i) {
      const PolarisedReflectance rho = fresnel_polarised(cosine(angle_deg), n_hat(i));
      EXPECT_DOUBLE_EQ(batch(i), (rho.s + rho.p) / 2.0) << n_hat(i);
      EXPECT_DOUBLE_EQ(batch(i), fresnel_reflectance(cosine(angle_deg), n_hat(i))) << n_hat(i);
    }
  }
}

TEST(FresnelDifference, IsHalfTheDifferenceOfBothPolarisations) {
  constexpr double rounding = 1e-15;
  Eigen::ArrayXcd n_hat(Eigen::Index(materials.size()));
  std::copy(materials.begin(), materials.end(), n_hat.begin());
  for (const double angle_deg : {0.0, 20.0, 60.0, 85.0, 90.0}) {
    const double cos_theta_i = std::max(cosine(angle_deg), 0.0);
    const Eigen::ArrayXd difference = fresnel_difference(cos_theta_i, n_hat);
    ASSERT_EQ(difference.size(), n_hat.size());
    for (Eigen::Index i = 0; i < n_hat.size(); ++i) {
      const PolarisedReflectance rho = fresnel_polarised(cos_theta_i, n_hat(i));
      EXPECT_NEAR(difference(i), (rho.s - rho.p) / 2.0, rounding) << n_hat(i);
    }
  }
  EXPECT_LT(fresnel_difference(1.0, n_hat).abs().maxCoeff(), rounding);
}

TEST(FresnelDifference, IsTheWholeReflectanceAtBrewstersAngle) {
  const double cos_brewster = 1.0 / std::sqrt(1.0 + 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(fresnel_difference(cos_brewster, Eigen::ArrayXcd::Constant(1, 1.5))(0),
                   fresnel_reflectance(cos_brewster, Complex(1.5)));
}

TEST(FresnelDifference, RefusesArgumentsOutsideTheirRange) {
  EXPECT_THROW((void)fresnel_difference(1.1, Eigen::ArrayXcd::Constant(1, 1.5)), std::domain_error);
  EXPECT_THROW((void)fresnel_difference(0.5, Eigen::ArrayXcd::Constant(1, -1.5)),
               std::domain_error);
}

TEST(FresnelReflectance, RefusesArgumentsOutsideTheirRange) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double cos_theta_i : {-0.1, 1.1, not_a_number}) {
    EXPECT_THROW((void)fresnel_reflectance(cos_theta_i, Complex(1.5)), std::domain_error);
    EXPECT_THROW((void)fresnel_amplitudes(cos_theta_i, 1.5), std::domain_error);
  }
  for (const Complex n_hat : {Complex(0.0), Complex(-1.5), Complex(1.5, -0.1),
                              Complex(not_a_number), Complex(1.5, not_a_number)}) {
    EXPECT_THROW((void)fresnel_reflectance(0.5, n_hat), std::domain_error) << n_hat;
    EXPECT_THROW((void)fresnel_polarised(0.5, n_hat), std::domain_error) << n_hat;
    EXPECT_THROW((void)fresnel_reflectance(0.5, Eigen::ArrayXcd::Constant(2, n_hat)),
                 std::domain_error)
        << n_hat;
  }
}

TEST(DiffuseFresnelReflectance, IsTheIntegralOfTheReflectance) {
  constexpr double midpoint_error = 1e-7;  // of 20,000 strips, near grazing incidence
  constexpr int strips = 20'000;
  for (const double n : {1.1, 1.33, 1.5, 1.567, 1.8}) {
    double integral = 0.0;
    for (int i = 0; i < strips; ++i) {
      const double c = (i + 0.5) / strips;
      integral += 2.0 * c * fresnel_reflectance(c, Complex(n)) / strips;
    }
    EXPECT_NEAR(diffuse_fresnel_reflectance(n), integral, midpoint_error) << "n = " << n;
  }
}

TEST(DiffuseFresnelReflectance, RefusesAnIndexUpToOne) {
  for (const double n : {1.0, 0.9, -1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)diffuse_fresnel_reflectance(n), std::domain_error) << n;
  }
}

}  // namespace
}  // namespace gonio

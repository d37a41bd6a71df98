#include "emulator/surface/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/surface/every_model.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using test::is_close_relative;
using test::NamedSurface;
using test::random_direction;

constexpr unsigned seed = 20110701;
constexpr int pairs = 2000;  // of directions, per model

TEST(Brdf, IsReciprocalForEveryModel) {
  constexpr double rounding = 1e-12;     // relative
  constexpr double least_cosine = 0.01;  // where 1 + i.r keeps 12 digits
  for (const NamedSurface& model : test::every_model()) {
    std::mt19937 random(seed);
    for (int k = 0; k < pairs; ++k) {
      const Vector3 i = random_direction(random, least_cosine);
      const Vector3 r = random_direction(random, least_cosine);
      const ArrayXd forth = model.surface.brdf(i, r);
      const ArrayXd back = model.surface.brdf(r, i);
      for (Eigen::Index l = 0; l < forth.size(); ++l) {
        ASSERT_TRUE(is_close_relative(forth(l), back(l), rounding))
            << model.name << ", i = " << i.transpose() << ", r = " << r.transpose();
      }
    }
  }
}

TEST(Brdf, IsFiniteAndNotNegativeForEveryModel) {
  for (const NamedSurface& model : test::every_model()) {
    std::mt19937 random(seed);
    double largest = 0.0;
    for (int k = 0; k < pairs; ++k) {
      const Vector3 i = random_direction(random);
      const ArrayXd f_r = model.surface.brdf(i, random_direction(random));
      ASSERT_TRUE((f_r >= 0.0).all() && f_r.isFinite().all()) << model.name << ": " << f_r;
      largest = std::max(largest, model.surface.brdf(i, mirrored(i)).minCoeff());
    }
    EXPECT_GT(largest, 0.02) << model.name << " reflects nothing";
  }
}

TEST(Brdf, IsZeroBelowTheHorizonForEveryModel) {
  for (const NamedSurface& model : test::every_model()) {
    std::mt19937 random(seed);
    for (int k = 0; k < pairs; ++k) {
      const Vector3 i = random_direction(random);
      Vector3 below = random_direction(random);
      below.z() = k % 100 == 0 ? 0.0 : -below.z();
      const ArrayXd f_r = model.surface.brdf(i, below);
      ASSERT_TRUE((f_r == 0.0).all()) << model.name << ", r = " << below.transpose();
    }
  }
}

TEST(Brdf, DoesNotChangeWithTheAzimuthOfBothDirectionsButForWardsTwoSlopes) {
  constexpr double rounding = 1e-11;  // relative; the turn itself rounds the directions
  for (const NamedSurface& model : test::every_model()) {
    std::mt19937 random(seed);
    double largest = 0.0;
    for (int k = 0; k < 50; ++k) {
      const Vector3 i = random_direction(random, 0.1);
      const Vector3 r = random_direction(random, 0.1);
      const auto turned = [](const Vector3& omega) {
        return Vector3(0.6 * omega.x() - 0.8 * omega.y(), 0.8 * omega.x() + 0.6 * omega.y(),
                       omega.z());
      };
      const ArrayXd straight = model.surface.brdf(i, r);
      largest = std::max(
          largest,
          ((model.surface.brdf(turned(i), turned(r)) - straight).abs() / straight).maxCoeff());
    }
    const bool has_two_slopes = model.name == "ward of two slopes" || model.name == "mixture";
    if (has_two_slopes) {
      EXPECT_GT(largest, 0.1) << model.name;
    } else {
      EXPECT_LT(largest, rounding) << model.name;
    }
  }
}

TEST(Surface, SumsItsLobesAndItsInterfaces) {
  constexpr double rounding = 1e-14;
  std::mt19937 random(seed);
  const auto models = test::every_model();
  Surface both = models[1].surface;
  for (const Surface& other : {models[7].surface, models[8].surface}) {
    both.lobes.insert(both.lobes.end(), other.lobes.begin(), other.lobes.end());
    both.interfaces.insert(both.interfaces.end(), other.interfaces.begin(), other.interfaces.end());
  }
  for (int k = 0; k < 100; ++k) {
    const Vector3 i = random_direction(random);
    const Vector3 r = random_direction(random);
    const ArrayXd sum =
        models[1].surface.brdf(i, r) + models[7].surface.brdf(i, r) + models[8].surface.brdf(i, r);
    EXPECT_LT(((both.brdf(i, r) - sum) / sum).abs().maxCoeff(), rounding);
    const ArrayXd specular = models[7].surface.specular_reflectance(i.z()) +
                             models[8].surface.specular_reflectance(i.z());
    EXPECT_LT((both.specular_reflectance(i.z()) - specular).abs().maxCoeff(), rounding);
  }
}

// Polarisation.

TEST(PolarisedSurface, IsUnpolarisedInTheMeanOfBothAndNeverNegative) {
  constexpr double rounding = 1e-14;
  for (const NamedSurface& model : test::every_model()) {
    std::mt19937 random(seed);
    const Surface s = polarised(model.surface, 1.0);
    const Surface p = polarised(model.surface, -1.0);
    for (int k = 0; k < 100; ++k) {
      const Vector3 i = random_direction(random);
      const Vector3 r = random_direction(random);
      const ArrayXd mean = 0.5 * (s.brdf(i, r) + p.brdf(i, r));
      EXPECT_LT((mean - model.surface.brdf(i, r)).abs().maxCoeff(), rounding * mean.maxCoeff())
          << model.name;
      EXPECT_GE(p.brdf(i, r).minCoeff(), 0.0) << model.name;
      EXPECT_LT((0.5 * (s.specular_reflectance(i.z()) + p.specular_reflectance(i.z())) -
                 model.surface.specular_reflectance(i.z()))
                    .abs()
                    .maxCoeff(),
                rounding)
          << model.name;
    }
  }
}

// Each reflects in its mirror direction, but for the diffuse part, R_s and R_p of its facets.
TEST(PolarisedSurface, ReflectsByFresnelsFormulaOfItsFacets) {
  constexpr double rounding = 1e-12;
  const std::complex<double> metal(1.15, 2.5);
  const WavelengthGrid one(nanometres(550), nanometres(1), 1);
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(1, metal);
  const Vector3 i = source_frame(degrees(60)).axis;
  const PolarisedReflectance R = fresnel_polarised(i.z(), metal);
  const double expected = R.s / R.p;
  for (const Surface& surface :
       {cook_torrance(one, 0.2, n_hat), ggx(one, 0.3, n_hat),
        coherent_roughness(one, nanometres(120), micrometres(1.5), n_hat),
        mixture({cook_torrance(one, 0.2, n_hat), ggx(one, 0.3, n_hat)}, {0.3, 0.6})}) {
    const double s = polarised(surface, 1.0).brdf(i, mirrored(i))(0);
    const double p = polarised(surface, -1.0).brdf(i, mirrored(i))(0);
    EXPECT_TRUE(is_close_relative(s / p, expected, rounding));
  }
  for (const Surface& surface :
       {smooth(one, n_hat), coherent_roughness(one, nanometres(120), micrometres(1.5), n_hat),
        mixture({smooth(one, n_hat), smooth(one, n_hat)}, {0.3, 0.6})}) {
    const double s = polarised(surface, 1.0).specular_reflectance(i.z())(0);
    const double p = polarised(surface, -1.0).specular_reflectance(i.z())(0);
    EXPECT_TRUE(is_close_relative(s / p, expected, rounding));
  }
}

TEST(PolarisedSurface, IsTheSameWhereTheModelHasNoPolarisation) {
  const WavelengthGrid& grid = test::two_wavelengths;
  const ArrayXd grey = ArrayXd::Constant(2, 0.5);
  const Vector3 i = source_frame(degrees(60)).axis;
  for (const Surface& surface :
       {lambertian(grid, grey), ward(grid, 0.1, 0.2, {.specular = 0.4, .diffuse = grey})}) {
    EXPECT_EQ(polarised(surface, 0.7).brdf(i, mirrored(i))(0), surface.brdf(i, mirrored(i))(0));
  }
  EXPECT_EQ(polarised(smooth(grid, 0.5), 0.7).specular_reflectance(0.5)(0), 0.5);
}

TEST(PolarisedSurface, NeedsAPolarizationOfAtMostOne) {
  const Surface mirror = smooth(test::two_wavelengths, 1.0);
  EXPECT_THROW((void)polarised(mirror, 1.001), std::domain_error);
  EXPECT_THROW((void)polarised(mirror, -1.001), std::domain_error);
  EXPECT_THROW((void)polarised(mirror, std::nan("")), std::domain_error);
}

TEST(HalfAngleCosine, IsTheCosineBetweenADirectionAndTheBisector) {
  constexpr double rounding = 1e-14;
  std::mt19937 random(seed);
  const Vector3 i = random_direction(random);
  DirectionBatch batch;
  batch.resize(100);
  for (Eigen::Index j = 0; j < batch.size(); ++j) {
    const Vector3 r = random_direction(random);
    batch.x(j) = r.x();
    batch.y(j) = r.y();
    batch.z(j) = r.z();
  }
  ArrayXd cos_theta_d(batch.size());
  half_angle_cosine(i, batch, cos_theta_d);
  for (Eigen::Index j = 0; j < batch.size(); ++j) {
    const Vector3 h = (i + Vector3(batch.x(j), batch.y(j), batch.z(j))).normalized();
    EXPECT_TRUE(test::is_close(cos_theta_d(j), i.dot(h), rounding)) << j;
  }
}

}  // namespace
}  // namespace gonio

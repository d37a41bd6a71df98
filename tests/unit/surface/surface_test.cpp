#include "emulator/surface/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

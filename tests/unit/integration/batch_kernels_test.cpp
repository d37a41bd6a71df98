#include "emulator/integration/batch_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;
using test::is_close;

constexpr unsigned seed = 20110905;
constexpr double rounding = 1e-13;  // of a few hundred terms of size 1
/// Odd sizes, sizes up to two vectors of eight lanes, and sizes round the block of 128.
const std::vector<Index> sizes = {1,  2,  3,  4,  5,  6,  7,   8,   9,   10,  11, 12,
                                  13, 14, 15, 16, 17, 31, 127, 128, 129, 255, 300};

ArrayXd random_array(std::mt19937& random, Index n, double low, double high) {
  std::uniform_real_distribution<double> uniform(low, high);
  return ArrayXd::NullaryExpr(n, [&](Index) { return uniform(random); });
}

TEST(TangentDirections, EqualTheFrameAndCountTheProjectedSolidAngle) {
  std::mt19937 random(seed);
  for (const double theta : {0.0, 20.0, 60.0, 85.0, 89.9}) {
    const Frame frame = receptor_frame(degrees(theta));
    for (const Index n : sizes) {
      const ArrayXd u = random_array(random, n, -1.0, 1.0);
      const ArrayXd v = random_array(random, n, -1.0, 1.0);
      DirectionBatch omega;
      omega.resize(n);
      ArrayXd factor = ArrayXd::LinSpaced(n, 1.0, 2.0);
      const ArrayXd before = factor;
      kernel::tangent_directions(frame, u, v, omega, factor);
      for (Index j = 0; j < n; ++j) {
        const Vector3 expected = frame.direction(u(j), v(j));
        EXPECT_TRUE(is_close(omega.x(j), expected.x(), rounding)) << j << " of " << n;
        EXPECT_TRUE(is_close(omega.y(j), expected.y(), rounding)) << j << " of " << n;
        EXPECT_TRUE(is_close(omega.z(j), expected.z(), rounding)) << j << " of " << n;
        const double jacobian = std::pow(1.0 + u(j) * u(j) + v(j) * v(j), -1.5);
        EXPECT_TRUE(
            is_close(factor(j), before(j) * jacobian * std::max(expected.z(), 0.0), rounding))
            << j << " of " << n << " at " << theta;
        EXPECT_TRUE(omega.z(j) > 0.0 || factor(j) == 0.0) << j << " of " << n;
      }
    }
  }
}

TEST(ChebyshevMoments, AreSumsOfPolynomialsAndAddUp) {
  std::mt19937 random(seed);
  for (const Index terms : {1, 2, 7, 24}) {
    for (const Index n : sizes) {
      const ArrayXd x = random_array(random, n, -1.0, 1.0);
      const ArrayXd f = random_array(random, n, 0.0, 1.0);
      VectorXd moment = VectorXd::Constant(terms, 3.0);
      kernel::add_chebyshev_moments(x, f, moment);
      for (Index k = 0; k < terms; ++k) {
        const double expected = 3.0 + (f * (double(k) * x.acos()).cos()).sum();
        EXPECT_TRUE(is_close(moment(k), expected, rounding * double(n)))
            << "moment " << k << " of " << n;
      }
    }
  }
}

TEST(ChebyshevSeriesKernel, EqualsTheSumOfItsTerms) {
  std::mt19937 random(seed);
  for (const Index terms : {1, 2, 7, 24}) {
    const VectorXd coefficient = random_array(random, terms, -1.0, 1.0).matrix();
    for (const Index n : sizes) {
      const ArrayXd x = random_array(random, n, -1.0, 1.0);
      ArrayXd value(n);
      kernel::chebyshev_series(coefficient, x, value);
      for (Index j = 0; j < n; ++j) {
        double expected = 0.0;
        for (Index k = 0; k < terms; ++k) {
          expected += coefficient(k) * std::cos(double(k) * std::acos(x(j)));
        }
        EXPECT_TRUE(is_close(value(j), expected, rounding)) << j << " of " << n;
      }
    }
  }
}

TEST(HalfAngleArgument, IsTheScaledCosineOfTheHalfAngleWithinMinusOneToOne) {
  std::mt19937 random(seed);
  constexpr double scale = 4.0;
  constexpr double shift = -3.0;
  const Vector3 omega_i = source_frame(degrees(60)).axis;
  for (const Index n : sizes) {
    DirectionBatch omega_r;
    omega_r.resize(n);
    ArrayXd factor = ArrayXd::Ones(n);
    kernel::tangent_directions(receptor_frame(degrees(20)), random_array(random, n, -3.0, 3.0),
                               random_array(random, n, -3.0, 3.0), omega_r, factor);
    ArrayXd x(n);
    kernel::half_angle_argument(omega_i, omega_r, scale, shift, x);
    for (Index j = 0; j < n; ++j) {
      const Vector3 r(omega_r.x(j), omega_r.y(j), omega_r.z(j));
      const double cos_d = omega_i.dot((omega_i + r).normalized());
      const double expected = std::clamp(scale * cos_d + shift, -1.0, 1.0);
      EXPECT_TRUE(is_close(x(j), expected, rounding)) << j << " of " << n;
    }
  }
}

}  // namespace
}  // namespace gonio

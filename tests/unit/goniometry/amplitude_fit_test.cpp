#include "emulator/goniometry/amplitude_fit.hpp"

#include <gtest/gtest.h>

namespace gonio::test {
namespace {

constexpr double rounding = 1e-12;

const Eigen::MatrixXd terms = (Eigen::MatrixXd(3, 2) << 1, 0, 0, 1, 1, 1).finished();

TEST(AmplitudeFit, ReturnsAmplitudesWithinTheBounds) {
  const Eigen::Vector2d k(0.5, 0.3);
  const AmplitudeFit fit = fit_amplitudes(terms, terms * k, 1.0);
  EXPECT_TRUE(fit.amplitudes.isApprox(k, rounding));
  EXPECT_EQ(fit.free.cols(), 2);
}

TEST(AmplitudeFit, StaysAtZero) {
  const AmplitudeFit fit = fit_amplitudes(terms, terms * Eigen::Vector2d(0.5, -0.2), 1.0);
  EXPECT_EQ(fit.amplitudes(1), 0.0);
  EXPECT_GT(fit.amplitudes(0), 0.0);
  EXPECT_EQ(fit.free.cols(), 1);
}

/// The nearest point of k_1 + k_2 = 1 to (0.9, 0.7) by symmetry of the terms is (0.6, 0.4).
TEST(AmplitudeFit, KeepsTheSumWithinItsLimit) {
  const AmplitudeFit fit = fit_amplitudes(terms, terms * Eigen::Vector2d(0.9, 0.7), 1.0);
  EXPECT_NEAR(fit.amplitudes(0), 0.6, rounding);
  EXPECT_NEAR(fit.amplitudes(1), 0.4, rounding);
  ASSERT_EQ(fit.free.cols(), 1);
  EXPECT_NEAR(fit.free.col(0).sum(), 0.0, rounding);
}

}  // namespace
}  // namespace gonio::test

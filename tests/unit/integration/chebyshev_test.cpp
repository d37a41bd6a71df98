#include "emulator/integration/chebyshev.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using test::is_close;

constexpr double rounding = 1e-14;  // of sums of up to 65 terms of size 1

/// Something like copper: more reflecting in the red.
ArrayXcd copper_like() {
  ArrayXcd n_hat(3);
  n_hat << std::complex<double>(1.18, 2.21), std::complex<double>(0.95, 2.58),
      std::complex<double>(0.21, 3.95);
  return n_hat;
}

double series_at(const ColourSeries& series, double c, Eigen::Index lambda) {
  const double x = std::clamp(series.scale * c + series.shift, -1.0, 1.0);
  double sum = 0.0;
  for (Eigen::Index k = 0; k < series.coefficient.rows(); ++k) {
    sum += series.coefficient(k, lambda) * std::cos(double(k) * std::acos(x));
  }
  return sum;
}

/// The largest difference between a colour and its series, over the range and all wavelengths.
double largest_error(const ColourSeries& series, const Colour& colour, double low, double high) {
  constexpr int samples = 400;
  double worst = 0.0;
  for (int j = 0; j <= samples; ++j) {
    const double c = low + (high - low) * j / samples;
    const ArrayXd expected = colour(c);
    for (Eigen::Index l = 0; l < expected.size(); ++l) {
      worst = std::max(worst, std::abs(series_at(series, c, l) - expected(l)));
    }
  }
  return worst;
}

TEST(ColourSeries, ReproducesFresnelToTheAccuracyAskedFor) {
  const ArrayXcd n_hat = copper_like();
  const Colour colour = [&](double c) { return fresnel_reflectance(c, n_hat); };
  struct Range {
    double low, high;
  };
  // A glossmeter at 20 deg and at 60 deg, and all of a hemisphere seen from the normal.
  for (const Range range : {Range{0.92, 0.96}, Range{0.4, 0.6}, Range{0.7071, 1.0}}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const ColourSeries series(colour, range.low, range.high, accuracy);
      EXPECT_LE(largest_error(series, colour, range.low, range.high), accuracy)
          << range.low << " to " << range.high << ", " << series.coefficient.rows() << " terms";
    }
  }
}

TEST(ColourSeries, BoundsWhatItLeavesOut) {
  // A glossmeter at 85 deg, and a hemisphere seen from there, where a metal changes fast.
  const ArrayXcd n_hat = copper_like();
  const Colour colour = [&](double c) { return fresnel_reflectance(c, n_hat); };
  for (const double low : {0.001, 0.03}) {
    for (const double high : {0.14, 0.75, 1.0}) {
      for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
        const ColourSeries series(colour, low, high, accuracy);
        EXPECT_LE(largest_error(series, colour, low, high),
                  std::max(accuracy, series.truncation.maxCoeff()))
            << low << " to " << high << " to " << accuracy;
      }
    }
  }
}

TEST(ColourSeries, NeedsOneTermForAConstant) {
  const Colour colour = [](double) -> ArrayXd { return ArrayXd::Constant(2, 0.37); };
  const ColourSeries series(colour, 0.2, 0.9, 1e-9);
  EXPECT_EQ(series.coefficient.rows(), 1);
  EXPECT_TRUE(is_close(series.coefficient(0, 0), 0.37, rounding));
  EXPECT_LT(series.truncation.maxCoeff(), rounding);
}

TEST(ColourSeries, MapsItsRangeOnMinusOneToOne) {
  const Colour colour = [](double c) -> ArrayXd { return ArrayXd::Constant(1, c); };
  const ColourSeries series(colour, 0.2, 0.9, 1e-9);
  EXPECT_TRUE(is_close(series.scale * 0.2 + series.shift, -1.0, rounding));
  EXPECT_TRUE(is_close(series.scale * 0.9 + series.shift, 1.0, rounding));
}

TEST(ChebyshevInterpolation, HasRowsThatSumToOne) {
  const ArrayXd x = ArrayXd::LinSpaced(101, -1.0, 1.0);
  for (const Eigen::Index n : {2, 3, 5, 9, 17, 33, 65}) {
    const Eigen::MatrixXd weight = chebyshev_interpolation(n, x);
    ASSERT_EQ(weight.rows(), x.size());
    ASSERT_EQ(weight.cols(), n);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_TRUE(is_close(weight.row(i).sum(), 1.0, rounding)) << "n = " << n << ", " << x(i);
    }
  }
}

TEST(ChebyshevInterpolation, GivesTheValuesAtItsPoints) {
  for (const Eigen::Index n : {2, 5, 17}) {
    const Eigen::MatrixXd weight = chebyshev_interpolation(n, chebyshev_points(n));
    EXPECT_EQ(weight, Eigen::MatrixXd::Identity(n, n)) << n;
  }
}

TEST(ChebyshevInterpolation, IsExactForPolynomialsOfItsDegree) {
  const ArrayXd x = ArrayXd::LinSpaced(57, -1.0, 1.0);
  for (const Eigen::Index n : {2, 3, 5, 9}) {
    const ArrayXd point = chebyshev_points(n);
    const Eigen::MatrixXd weight = chebyshev_interpolation(n, x);
    for (int degree = 0; degree < n; ++degree) {
      const ArrayXd got = weight * point.pow(degree).matrix();
      EXPECT_LT((got - x.pow(degree)).abs().maxCoeff(), rounding) << n << ", degree " << degree;
    }
  }
}

TEST(ChebyshevPoints, AscendFromMinusOneToOne) {
  for (const Eigen::Index n : {2, 3, 9, 65}) {
    const ArrayXd point = chebyshev_points(n);
    ASSERT_EQ(point.size(), n);
    EXPECT_EQ(point(0), -1.0);
    EXPECT_EQ(point(n - 1), 1.0);
    for (Eigen::Index j = 1; j < n; ++j) {
      EXPECT_GT(point(j), point(j - 1)) << n;
    }
  }
}

}  // namespace
}  // namespace gonio

#include "emulator/statistics/control_chart_constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;

constexpr double pi = std::numbers::pi;
// What two quadratures of 16 digits leave.
constexpr double rounding = 1e-12;

struct Printed {
  std::size_t n;
  double A2, A3, c4, B3, B4, d2, d3, D3, D4;
};

// Montgomery, Introduction to Statistical Quality Control, appendix VI: factors for constructing
// variables control charts.
const std::vector<Printed> montgomery = {
    {2, 1.880, 2.659, 0.7979, 0.000, 3.267, 1.128, 0.853, 0.000, 3.267},
    {3, 1.023, 1.954, 0.8862, 0.000, 2.568, 1.693, 0.888, 0.000, 2.574},
    {4, 0.729, 1.628, 0.9213, 0.000, 2.266, 2.059, 0.880, 0.000, 2.282},
    {5, 0.577, 1.427, 0.9400, 0.000, 2.089, 2.326, 0.864, 0.000, 2.114},
    {6, 0.483, 1.287, 0.9515, 0.030, 1.970, 2.534, 0.848, 0.000, 2.004},
    {7, 0.419, 1.182, 0.9594, 0.118, 1.882, 2.704, 0.833, 0.076, 1.924},
    {8, 0.373, 1.099, 0.9650, 0.185, 1.815, 2.847, 0.820, 0.136, 1.864},
    {9, 0.337, 1.032, 0.9693, 0.239, 1.761, 2.970, 0.808, 0.184, 1.816},
    {10, 0.308, 0.975, 0.9727, 0.284, 1.716, 3.078, 0.797, 0.223, 1.777},
    {11, 0.285, 0.927, 0.9754, 0.321, 1.679, 3.173, 0.787, 0.256, 1.744},
    {12, 0.266, 0.886, 0.9776, 0.354, 1.646, 3.258, 0.778, 0.283, 1.717},
    {13, 0.249, 0.850, 0.9794, 0.382, 1.618, 3.336, 0.770, 0.307, 1.693},
    {14, 0.235, 0.817, 0.9810, 0.406, 1.594, 3.407, 0.763, 0.328, 1.672},
    {15, 0.223, 0.789, 0.9823, 0.428, 1.572, 3.472, 0.756, 0.347, 1.653},
    {16, 0.212, 0.763, 0.9835, 0.448, 1.552, 3.532, 0.750, 0.363, 1.637},
    {17, 0.203, 0.739, 0.9845, 0.466, 1.534, 3.588, 0.744, 0.378, 1.622},
    {18, 0.194, 0.718, 0.9854, 0.482, 1.518, 3.640, 0.739, 0.391, 1.608},
    {19, 0.187, 0.698, 0.9862, 0.497, 1.503, 3.689, 0.734, 0.403, 1.597},
    {20, 0.180, 0.680, 0.9869, 0.510, 1.490, 3.735, 0.729, 0.415, 1.585},
    {21, 0.173, 0.663, 0.9876, 0.523, 1.477, 3.778, 0.724, 0.425, 1.575},
    {22, 0.167, 0.647, 0.9882, 0.534, 1.466, 3.819, 0.720, 0.434, 1.566},
    {23, 0.162, 0.633, 0.9887, 0.545, 1.455, 3.858, 0.716, 0.443, 1.557},
    {24, 0.157, 0.619, 0.9892, 0.555, 1.445, 3.895, 0.712, 0.451, 1.548},
    {25, 0.153, 0.606, 0.9896, 0.565, 1.435, 3.931, 0.708, 0.459, 1.541}};

// One unit of the last digit: some of the printed factors are made of others that were rounded.
TEST(ControlChartConstants, EqualTheTableOfMontgomery) {
  constexpr double printed = 0.001, printed_c4 = 0.00005;
  for (const Printed& row : montgomery) {
    SCOPED_TRACE(row.n);
    const ControlChartConstants& got = control_chart_constants(row.n);
    EXPECT_TRUE(is_close(got.A2, row.A2, printed));
    EXPECT_TRUE(is_close(got.A3, row.A3, printed));
    EXPECT_TRUE(is_close(got.c4, row.c4, printed_c4));
    EXPECT_TRUE(is_close(got.B3, row.B3, printed));
    EXPECT_TRUE(is_close(got.B4, row.B4, printed));
    EXPECT_TRUE(is_close(got.d2, row.d2, printed));
    EXPECT_TRUE(is_close(got.d3, row.d3, printed));
    EXPECT_TRUE(is_close(got.D3, row.D3, printed));
    EXPECT_TRUE(is_close(got.D4, row.D4, printed));
  }
}

// The difference of two normal values is normal with sqrt(2) sigma: its size has mean 2 / sqrt(pi)
// and mean square 2.
TEST(ControlChartConstants, OfTwoHaveClosedForms) {
  const ControlChartConstants& got = control_chart_constants(2);
  EXPECT_TRUE(is_close_relative(got.d2, 2.0 / std::sqrt(pi), rounding));
  EXPECT_TRUE(is_close_relative(got.d3, std::sqrt(2.0 - 4.0 / pi), rounding));
  EXPECT_TRUE(is_close_relative(got.c4, std::sqrt(2.0 / pi), rounding));
  EXPECT_TRUE(is_close_relative(got.E2, 1.5 * std::sqrt(pi), rounding));
}

// Moments of the range of 3, 4 and 5 normal values, e.g. H. A. David, Order Statistics.
TEST(ControlChartConstants, OfThreeToFiveHaveClosedForms) {
  const double a = std::asin(1.0 / 3.0);
  EXPECT_TRUE(is_close_relative(control_chart_constants(3).d2, 3.0 / std::sqrt(pi), rounding));
  EXPECT_TRUE(is_close_relative(control_chart_constants(3).d3,
                                std::sqrt(2.0 + 3.0 * std::sqrt(3.0) / pi - 9.0 / pi), rounding));
  EXPECT_TRUE(is_close_relative(control_chart_constants(4).d2,
                                3.0 / std::sqrt(pi) * (1.0 + 2.0 * a / pi), rounding));
  EXPECT_TRUE(is_close_relative(control_chart_constants(5).d2,
                                2.5 / std::sqrt(pi) * (1.0 + 6.0 * a / pi), rounding));
}

// d2 is also the integral of 1 - Phi^n - (1 - Phi)^n over all x (Tippett, Biometrika 17, 364,
// 1925).
TEST(ControlChartConstants, EqualTheIntegralOfTippettUpToAHundred) {
  for (const std::size_t n : {2u, 7u, 25u, 60u, 100u}) {
    double sum = 0.0;
    for (int i = -320; i <= 320; ++i) {
      const double above = std::erfc(double(i) / 32.0 / std::numbers::sqrt2) / 2.0;
      sum += 1.0 - std::pow(1.0 - above, double(n)) - std::pow(above, double(n));
    }
    EXPECT_TRUE(is_close_relative(control_chart_constants(n).d2, sum / 32.0, rounding)) << n;
  }
}

// Seed 31; 20000 ranges each.
TEST(ControlChartConstants, AreMeanAndSpreadOfRangesThatAreDrawn) {
  constexpr double standard_errors = 4.0;
  constexpr int ranges = 20000;
  std::mt19937_64 random(31);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {5u, 100u}) {
    RunningStatistics drawn;
    for (int i = 0; i < ranges; ++i) {
      std::vector<double> x(n);
      std::generate(x.begin(), x.end(), [&] { return normal(random); });
      const auto [low, high] = std::minmax_element(x.begin(), x.end());
      drawn.add(*high - *low);
    }
    const ControlChartConstants& got = control_chart_constants(n);
    EXPECT_TRUE(is_close(drawn.result().mean, got.d2,
                         standard_errors * got.d3 / std::sqrt(double(ranges))));
    // The spread of a standard deviation of nearly normal values.
    EXPECT_TRUE(is_close(drawn.result().standard_deviation, got.d3,
                         1.2 * standard_errors * got.d3 / std::sqrt(2.0 * ranges)));
  }
}

TEST(ControlChartConstants, AreKnownFrom2To100) {
  EXPECT_EQ(&control_chart_constants(6), &control_chart_constants(6));
  EXPECT_EQ(test::message_of([] { (void)control_chart_constants(1); }),
            "control_chart_constants: expected n in [2, 100], found 1");
  EXPECT_THROW((void)control_chart_constants(101), std::domain_error);
}

}  // namespace
}  // namespace gonio

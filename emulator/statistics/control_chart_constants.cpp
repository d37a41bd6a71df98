#include "emulator/statistics/control_chart_constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "emulator/statistics/normal.hpp"

namespace gonio {
namespace {

// The probability that the range of n standard normal values is above w, from
//
//   P(W <= w) = n int phi(x) (Phi(x + w) - Phi(x))^(n - 1) dx.
//
// The rule of equal steps has all digits for what dies away like exp(-x^2) on both sides.
double range_above(double w, double n) {
  constexpr double step = 1.0 / 16.0;
  double sum = 0.0;
  for (int i = 0; i <= int(2.0 * normal_reach / step); ++i) {
    const double x = i * step - normal_reach;
    sum += normal_density(x) * std::pow(normal_below(x + w) - normal_below(x), n - 1.0);
  }
  return 1.0 - n * sum * step;
}

struct RangeMoments {
  double mean = 0.0, standard_deviation = 0.0;
};

RangeMoments range_moments(double n) {
  // No range of 100 normal values is above in any double.
  constexpr double highest = 16.0;
  constexpr int pieces = 8;
  RangeMoments result;
  double second = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double low = highest * i / pieces, high = highest * (i + 1) / pieces;
    const auto over = [&](auto f) {
      return boost::math::quadrature::gauss<double, 15>::integrate(f, low, high);
    };
    result.mean += over([&](double w) { return range_above(w, n); });
    second += over([&](double w) { return 2.0 * w * range_above(w, n); });
  }
  result.standard_deviation = std::sqrt(second - result.mean * result.mean);
  return result;
}

ControlChartConstants computed(std::size_t size) {
  const double n = double(size), root_n = std::sqrt(n);
  const RangeMoments range = range_moments(n);
  const double c4 =
      std::sqrt(2.0 / (n - 1.0)) * std::exp(std::lgamma(n / 2.0) - std::lgamma((n - 1.0) / 2.0));
  const double range_limit = 3.0 * range.standard_deviation / range.mean;
  const double deviation_limit = 3.0 * std::sqrt(1.0 - c4 * c4) / c4;
  return {.d2 = range.mean,
          .d3 = range.standard_deviation,
          .c4 = c4,
          .A2 = 3.0 / (range.mean * root_n),
          .D3 = std::max(1.0 - range_limit, 0.0),
          .D4 = 1.0 + range_limit,
          .A3 = 3.0 / (c4 * root_n),
          .B3 = std::max(1.0 - deviation_limit, 0.0),
          .B4 = 1.0 + deviation_limit,
          .E2 = 3.0 / range.mean};
}

}  // namespace

const ControlChartConstants& control_chart_constants(std::size_t n) {
  if (n < 2 || n > largest_subgroup) {
    throw std::domain_error(fmt::format("control_chart_constants: expected n in [2, {}], found {}",
                                        largest_subgroup, n));
  }
  // Each takes milliseconds and a program asks for few of them, but for those with every subgroup.
  static std::array<std::once_flag, largest_subgroup + 1> known;
  static std::array<ControlChartConstants, largest_subgroup + 1> constants;
  std::call_once(known[n], [n] { constants[n] = computed(n); });
  return constants[n];
}

}  // namespace gonio

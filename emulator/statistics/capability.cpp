#include "emulator/statistics/capability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "emulator/statistics/within_limits.hpp"

namespace gonio {
namespace {

struct Indices {
  std::optional<Estimate> both_sides, nearer_side;
};

void expect_limits(const Interval& limits) {
  if (!limits.low && !limits.high) {
    throw std::domain_error("capability: expected a limit, found none");
  }
  if (limits.low && limits.high && !(*limits.low < *limits.high)) {
    throw std::domain_error(fmt::format("capability: expected limits in order, found {} and {}",
                                        *limits.low, *limits.high));
  }
}

void expect_spread(const EstimatedSpread& spread) {
  if (!(spread.value >= 0.0)) {
    throw std::domain_error(
        fmt::format("capability: expected a spread >= 0, found {}", spread.value));
  }
  if (spread.value > 0.0 && !(spread.degrees_of_freedom > 0.0)) {
    throw std::domain_error(fmt::format("capability: expected degrees of freedom > 0, found {}",
                                        spread.degrees_of_freedom));
  }
}

// The spread is the only thing that C_p estimates.
Estimate by_chi_squared(double value, double degrees_of_freedom, double tail) {
  const boost::math::chi_squared_distribution chi_squared(degrees_of_freedom);
  return {.value = value,
          .low = value * std::sqrt(quantile(chi_squared, tail) / degrees_of_freedom),
          .high = value * std::sqrt(quantile(complement(chi_squared, tail)) / degrees_of_freedom)};
}

Estimate by_bissell(double value, double n, double degrees_of_freedom, double tail) {
  const double z = std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * tail);
  const double half = z * std::sqrt(1.0 / (9.0 * n) + value * value / (2.0 * degrees_of_freedom));
  return {.value = value, .low = value - half, .high = value + half};
}

Indices indices(double mean, double n, const EstimatedSpread& spread, const Interval& limits,
                double confidence) {
  if (spread.value == 0.0) {
    return {};
  }
  const double tail = (1.0 - confidence) / 2.0;
  Indices result;
  if (limits.low && limits.high) {
    result.both_sides = by_chi_squared((*limits.high - *limits.low) / (6.0 * spread.value),
                                       spread.degrees_of_freedom, tail);
  }
  constexpr double none = std::numeric_limits<double>::infinity();
  const double nearer =
      std::min(limits.high ? *limits.high - mean : none, limits.low ? mean - *limits.low : none);
  result.nearer_side =
      by_bissell(nearer / (3.0 * spread.value), n, spread.degrees_of_freedom, tail);
  return result;
}

}  // namespace

Capability capability(double mean, std::size_t n, const EstimatedSpread& within,
                      const EstimatedSpread& overall, const Interval& limits, double confidence) {
  expect_limits(limits);
  expect_spread(within);
  expect_spread(overall);
  if (n < 2 || !std::isfinite(mean)) {
    throw std::domain_error(fmt::format(
        "capability: expected the mean of two values or more, found {} of {}", mean, n));
  }
  if (!(confidence > 0.0 && confidence < 1.0)) {
    throw std::domain_error(
        fmt::format("capability: expected confidence in (0, 1), found {}", confidence));
  }
  const Indices short_term = indices(mean, double(n), within, limits, confidence);
  const Indices long_term = indices(mean, double(n), overall, limits, confidence);
  return {.cp = short_term.both_sides,
          .cpk = short_term.nearer_side,
          .pp = long_term.both_sides,
          .ppk = long_term.nearer_side,
          .expected_beyond = beyond_limits(mean, overall.value, limits)};
}

}  // namespace gonio

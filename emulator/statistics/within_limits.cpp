#include "emulator/statistics/within_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "emulator/statistics/normal.hpp"

namespace gonio {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_sd(const char* function, double sd) {
  if (!(sd >= 0.0 && std::isfinite(sd))) {
    throw std::domain_error(fmt::format("{}: expected sd >= 0, found {}", function, sd));
  }
}

// Limits as numbers of standard deviations from the mean.
struct Scaled {
  double low, high;
};

Scaled scaled(double mean, double sd, const Interval& limits) {
  return {.low = limits.low ? (*limits.low - mean) / sd : -infinity,
          .high = limits.high ? (*limits.high - mean) / sd : infinity};
}

}  // namespace

bool is_within(double x, const Interval& limits) {
  return !(limits.low && x < *limits.low) && !(limits.high && x > *limits.high);
}

double within_limits(double mean, double sd, const Interval& limits) {
  expect_sd("within_limits", sd);
  if (sd == 0.0) {
    return is_within(mean, limits) ? 1.0 : 0.0;
  }
  const Scaled z = scaled(mean, sd, limits);
  // In the upper tail both terms are close to 1: there the other side has the digits.
  const double within = z.low > 0.0 ? normal_below(-z.low) - normal_below(-z.high)
                                    : normal_below(z.high) - normal_below(z.low);
  return std::max(within, 0.0);
}

double beyond_limits(double mean, double sd, const Interval& limits) {
  expect_sd("beyond_limits", sd);
  if (sd == 0.0) {
    return is_within(mean, limits) ? 0.0 : 1.0;
  }
  const Scaled z = scaled(mean, sd, limits);
  return std::min(normal_below(z.low) + normal_below(-z.high), 1.0);
}

}  // namespace gonio

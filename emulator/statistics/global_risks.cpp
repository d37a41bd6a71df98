#include "emulator/statistics/global_risks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "emulator/statistics/normal.hpp"
#include "emulator/statistics/within_limits.hpp"

namespace gonio {
namespace {

// Where the integrands are not smooth, or change within a standard uncertainty: limits of both
// kinds, and both sides of those of acceptance; in order, all within reach of the mean.
std::vector<double> breaks(double mean, double sd, double u, const Interval& tolerance,
                           const Interval& acceptance) {
  const double first = mean - normal_reach * sd, last = mean + normal_reach * sd;
  std::vector<double> result = {first, mean - 3.0 * sd, mean, mean + 3.0 * sd, last};
  const auto add = [&](double x) { result.push_back(std::clamp(x, first, last)); };
  for (const std::optional<double>& limit : {tolerance.low, tolerance.high}) {
    add(limit.value_or(mean));
  }
  for (const std::optional<double>& limit : {acceptance.low, acceptance.high}) {
    for (const double step : {-normal_reach, -3.0, 0.0, 3.0, normal_reach}) {
      add(limit.value_or(mean) + step * u);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

GlobalRisks global_risks(double mean, double sd, double u, const Interval& tolerance,
                         const Interval& acceptance) {
  if (!(sd >= 0.0 && u >= 0.0 && std::isfinite(sd) && std::isfinite(u))) {
    throw std::domain_error(
        fmt::format("global_risks: expected sd and u >= 0, found {} and {}", sd, u));
  }
  GlobalRisks risks;
  if (sd == 0.0) {
    (is_within(mean, tolerance) ? risks.producer : risks.consumer) =
        is_within(mean, tolerance) ? beyond_limits(mean, u, acceptance)
                                   : within_limits(mean, u, acceptance);
    return risks;
  }
  const std::vector<double> x = breaks(mean, sd, u, tolerance, acceptance);
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i - 1] == x[i]) {
      continue;
    }
    const bool conforms = is_within((x[i - 1] + x[i]) / 2.0, tolerance);
    const auto wrong = [&](double item) {
      return normal_density((item - mean) / sd) / sd *
             (conforms ? beyond_limits(item, u, acceptance) : within_limits(item, u, acceptance));
    };
    (conforms ? risks.producer : risks.consumer) +=
        boost::math::quadrature::gauss_kronrod<double, 31>::integrate(wrong, x[i - 1], x[i], 5,
                                                                      1e-10);
  }
  return risks;
}

}  // namespace gonio

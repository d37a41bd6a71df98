#include "emulator/statistics/sampling_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <cmath>
#include <stdexcept>

#include "emulator/statistics/normal.hpp"

namespace gonio {

double accepted_by_attributes(std::size_t n, std::size_t c, double p) {
  if (!(p >= 0.0 && p <= 1.0)) {
    throw std::domain_error(
        fmt::format("accepted_by_attributes: expected p in [0, 1], found {}", p));
  }
  return c >= n ? 1.0 : cdf(boost::math::binomial_distribution(double(n), p), double(c));
}

std::optional<double> accepted_by_variables(std::size_t n, double k, double mean, double sd,
                                            const Interval& limits) {
  if (n < 2 || !(sd >= 0.0 && std::isfinite(sd))) {
    throw std::domain_error(fmt::format(
        "accepted_by_variables: expected two values or more and sd >= 0, found {} and {}", n, sd));
  }
  if (limits.low && limits.high) {
    return std::nullopt;
  }
  if (!limits.low && !limits.high) {
    return 1.0;
  }
  const double margin = limits.high ? *limits.high - mean : mean - *limits.low;
  if (sd == 0.0) {
    return margin >= 0.0 ? 1.0 : 0.0;
  }
  const double freedom = double(n - 1), root_n = std::sqrt(double(n)), t = k * root_n;
  // Farther off nothing changes that a double could hold: s is at most 1 + 9 / sqrt(freedom) sigma,
  // and the mean within 9 / sqrt(n) of them. The series of the distribution would not end there.
  const double farthest = normal_reach + std::abs(t) * (1.0 + normal_reach / std::sqrt(freedom));
  const double delta = std::clamp(root_n * (margin / sd), -farthest, farthest);
  return cdf(complement(boost::math::non_central_t_distribution(freedom, delta), t));
}

}  // namespace gonio

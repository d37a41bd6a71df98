#pragma once

#include <cmath>
#include <numbers>

namespace gonio {

/// The probability that a standard normal value is below z, with all digits where it is small.
inline double normal_below(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2.0; }

inline double normal_density(double z) {
  return std::exp(-z * z / 2.0) / std::sqrt(2.0 * std::numbers::pi);
}

/// Beyond so many standard deviations there is nothing of it that counts beside 1 in a double.
constexpr double normal_reach = 9.0;

}  // namespace gonio

#pragma once

#include <optional>

#include "emulator/core/interval.hpp"
#include "emulator/statistics/estimate.hpp"

namespace gonio {

/// A standard deviation as it was estimated.
struct EstimatedSpread {
  double value = 0.0;               ///< >= 0
  double degrees_of_freedom = 0.0;  ///< of it, > 0
};

/// How well a process keeps within limits. The indices are
///
///   C_p = (U - L) / 6 s,   C_pk = min(U - mean, mean - L) / 3 s,
///
/// with s the spread within subgroups; P_p and P_pk the same with the overall one. With one limit
/// C_p and P_p are nothing; with a spread of 0 all are.
struct Capability {
  std::optional<Estimate> cp = {}, cpk = {}, pp = {}, ppk = {};
  /// Share expected beyond the limits, for a normal distribution of the overall spread.
  double expected_beyond = 0.0;
};

/// @param mean  of n values, n >= 2.
/// @param confidence  of the intervals: C_p by chi squared, C_pk by Bissell's approximation.
/// @throws std::domain_error  for limits that are neither, or not in order, fewer values, a
///                            negative spread.
/// @see    Montgomery, Introduction to Statistical Quality Control; Bissell, Applied Statistics 39,
///         331 (1990)
[[nodiscard]] Capability capability(double mean, std::size_t n, const EstimatedSpread& within,
                                    const EstimatedSpread& overall, const Interval& limits,
                                    double confidence = 0.95);

}  // namespace gonio

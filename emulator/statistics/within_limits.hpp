#pragma once

#include "emulator/core/interval.hpp"

namespace gonio {

/// A limit itself is within.
[[nodiscard]] bool is_within(double x, const Interval& limits);

/// The probability that a normal value lies within the limits: 1 without any, 0 for limits that are
/// not in order.
/// @param sd  >= 0.
/// @throws std::domain_error  for any other sd.
[[nodiscard]] double within_limits(double mean, double sd, const Interval& limits);

/// The other probability, with all digits where it is small.
/// @param sd, @throws  as above.
[[nodiscard]] double beyond_limits(double mean, double sd, const Interval& limits);

}  // namespace gonio

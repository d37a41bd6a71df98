#pragma once

#include <cstddef>
#include <optional>

#include "emulator/core/interval.hpp"
#include "emulator/statistics/global_risks.hpp"
#include "emulator/statistics/within_limits.hpp"

// What sampling plans accept, in closed form, and, as with a plan both are wanted, the normal
// probabilities and risks of the headers above. All throw std::domain_error for what is not in the
// range that they state.

namespace gonio {

/// The probability that a lot is accepted of which n are inspected and at most c may not conform.
/// @param p  share of the lot that does not conform, in [0, 1].
[[nodiscard]] double accepted_by_attributes(std::size_t n, std::size_t c, double p);

/// The probability that a plan by variables, sigma not known, accepts: (U - mean) / s >= k or
/// (mean - L) / s >= k, of n normal values, with one limit; nothing for two limits, for which there
/// is no closed form. By the noncentral t distribution. Without limits 1.
/// @param n  >= 2.   @param mean, sd  of the lot, sd >= 0.   @see ISO 3951-1, the s method
[[nodiscard]] std::optional<double> accepted_by_variables(std::size_t n, double k, double mean,
                                                          double sd, const Interval& limits);

}  // namespace gonio

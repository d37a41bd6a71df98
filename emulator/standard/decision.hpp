#pragma once

#include <string>

#include "emulator/core/interval.hpp"

namespace gonio {

/// What a case or a clause comes to.
enum class ConformanceVerdict {
  pass,
  fail,
  inconclusive,    ///< the expanded uncertainty straddles the limit
  not_applicable,  ///< the clause does not concern this device, or its number is not known
  skipped,         ///< could not be tried: the device does not offer it, or nobody was there
  error            ///< the device no longer answered, or the suite itself is at fault
};
[[nodiscard]] const char* verdict_name(ConformanceVerdict verdict);

/// What is said of a value whose uncertainty reaches over a limit. @see JCGM 106:2012
enum class DecisionRule {
  guarded,  ///< the guard band is U on both sides: pass and fail only where U leaves no doubt
  simple    ///< the value alone decides; U is shown
};
[[nodiscard]] std::string decision_rule_words(DecisionRule rule);

/// @param expanded_uncertainty  of `value`, k = 2, >= 0, in its unit.
[[nodiscard]] ConformanceVerdict decide(double value, double expanded_uncertainty,
                                        const Interval& limits, DecisionRule rule);

/// The probability that what was measured lies within the limits, for a value of normal
/// distribution. @param u  standard uncertainty of `value`, >= 0, in its unit. @return  in [0, 1].
/// @see    JCGM 106:2012, 7.3
[[nodiscard]] double conformance_probability(double value, double u, const Interval& limits);

/// The one that decides about several together: error, fail, inconclusive, pass, skipped, not
/// applicable, in this order.
[[nodiscard]] ConformanceVerdict worse(ConformanceVerdict a, ConformanceVerdict b);

}  // namespace gonio

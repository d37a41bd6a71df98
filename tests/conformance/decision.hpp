#pragma once

#include <optional>
#include <string>

#include "reports/conformance_report.hpp"

namespace gonio::conformance {

/// What is said of a value whose uncertainty reaches over a limit. @see JCGM 106:2012
enum class DecisionRule {
  guarded,  ///< the guard band is U on both sides: pass and fail only where U leaves no doubt
  simple    ///< the value alone decides; U is shown
};
[[nodiscard]] std::string decision_rule_words(DecisionRule rule);

/// The limits on one quantity, in its unit; nothing where there is none on that side.
struct Interval {
  std::optional<double> low = {}, high = {};
};

/// @param expanded_uncertainty  of `value`, k = 2, >= 0, in its unit.
[[nodiscard]] ConformanceVerdict decide(double value, double expanded_uncertainty,
                                        const Interval& limits, DecisionRule rule);

/// The one that decides about several together: error, fail, inconclusive, pass, skipped, not
/// applicable, in this order.
[[nodiscard]] ConformanceVerdict worse(ConformanceVerdict a, ConformanceVerdict b);

}  // namespace gonio::conformance

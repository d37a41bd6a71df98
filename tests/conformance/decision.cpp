#include "tests/conformance/decision.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gonio::conformance {

namespace {

using enum ConformanceVerdict;

/// A value that is stated to be at the limit is within it, whatever its last bit.
double rounding_of(double value) { return 1e-9 * std::max(1.0, std::abs(value)); }

}  // namespace

std::string decision_rule_words(DecisionRule rule) {
  return rule == DecisionRule::guarded
             ? "guarded: pass if the value is within the limit by at least U (k = 2), fail if it "
               "is "
               "beyond it by more than U, else inconclusive"
             : "simple: the value alone decides; U is shown and not taken into account";
}

ConformanceVerdict decide(double value, double expanded_uncertainty, const Interval& limits,
                          DecisionRule rule) {
  if (!std::isfinite(value)) {
    return fail;
  }
  const double guard = rule == DecisionRule::guarded ? expanded_uncertainty : 0.0;
  const double slack = rounding_of(value);
  // How far inside of the nearest limit, negative outside.
  double inside = std::numeric_limits<double>::infinity();
  if (limits.low) {
    inside = std::min(inside, value - *limits.low);
  }
  if (limits.high) {
    inside = std::min(inside, *limits.high - value);
  }
  if (inside + slack >= guard) {
    return pass;
  }
  return inside + guard + slack < 0.0 ? fail : inconclusive;
}

ConformanceVerdict worse(ConformanceVerdict a, ConformanceVerdict b) {
  constexpr std::array order{error, fail, inconclusive, pass, skipped, not_applicable};
  return std::find(order.begin(), order.end(), a) < std::find(order.begin(), order.end(), b) ? a
                                                                                             : b;
}

}  // namespace gonio::conformance

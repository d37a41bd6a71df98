#include "emulator/standard/decision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

using enum ConformanceVerdict;

/// A value that is stated to be at the limit is within it, whatever its last bit.
double rounding_of(double value) { return 1e-9 * std::max(1.0, std::abs(value)); }

}  // namespace

const char* verdict_name(ConformanceVerdict verdict) {
  switch (verdict) {
    case ConformanceVerdict::pass:
      return "pass";
    case ConformanceVerdict::fail:
      return "fail";
    case ConformanceVerdict::inconclusive:
      return "inconclusive";
    case ConformanceVerdict::not_applicable:
      return "not_applicable";
    case ConformanceVerdict::skipped:
      return "skipped";
    case ConformanceVerdict::error:
      break;
  }
  return "error";
}

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

double conformance_probability(double value, double u, const Interval& limits) {
  const auto below = [&](double limit) {
    if (u == 0.0) {
      return value <= limit + rounding_of(value) ? 1.0 : 0.0;
    }
    return 0.5 * std::erfc((value - limit) / (u * std::numbers::sqrt2));
  };
  const auto above = [&](double limit) {
    if (u == 0.0) {
      return value >= limit - rounding_of(value) ? 1.0 : 0.0;
    }
    return 0.5 * std::erfc((limit - value) / (u * std::numbers::sqrt2));
  };
  const double over = limits.high ? 1.0 - below(*limits.high) : 0.0;
  const double under = limits.low ? 1.0 - above(*limits.low) : 0.0;
  return std::clamp(1.0 - over - under, 0.0, 1.0);
}

ConformanceVerdict worse(ConformanceVerdict a, ConformanceVerdict b) {
  constexpr std::array order{error, fail, inconclusive, pass, skipped, not_applicable};
  return std::find(order.begin(), order.end(), a) < std::find(order.begin(), order.end(), b) ? a
                                                                                             : b;
}

}  // namespace gonio

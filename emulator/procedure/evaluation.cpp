#include "emulator/procedure/evaluation.hpp"

#include <cmath>

namespace gonio {

HazeResult haze(const HazeRule& rule, const std::map<std::string, double>& gloss_gu) {
  HazeResult result{.id = rule.id, .value = {}};
  const auto from = gloss_gu.find(rule.from);
  const auto minus = gloss_gu.find(rule.minus);
  if (from != gloss_gu.end() && minus != gloss_gu.end() &&
      (!rule.only_above || from->second > *rule.only_above)) {
    result.value = from->second - minus->second;
  }
  return result;
}

double reported_value(double gloss_gu, const Standard& standard) {
  if (!standard.rounding) {
    return gloss_gu;
  }
  // The quotient of two decimal fractions may fall short of a half by its last bits.
  constexpr double last_bits = 1e-9;
  const double step = standard.rounding->nominal;
  const double steps = std::floor(std::abs(gloss_gu) / step + 0.5 + last_bits);
  return steps == 0.0 ? 0.0 : std::copysign(steps * step, gloss_gu);
}

}  // namespace gonio

#pragma once

#include <cstddef>

namespace gonio {

/// Constants of control charts for normal values in subgroups of n, computed, not tabulated.
struct ControlChartConstants {
  double d2 = 0.0, d3 = 0.0;  ///< mean and standard deviation of the range, in sigma
  double c4 = 0.0;            ///< mean of the standard deviation, in sigma
  double A2 = 0.0, D3 = 0.0, D4 = 0.0;
  double A3 = 0.0, B3 = 0.0, B4 = 0.0;
  double E2 = 0.0;  ///< 3 / d2
};
constexpr std::size_t largest_subgroup = 100;
/// @param n  in [2, 100].   @throws std::domain_error  for anything else.
[[nodiscard]] const ControlChartConstants& control_chart_constants(std::size_t n);

}  // namespace gonio

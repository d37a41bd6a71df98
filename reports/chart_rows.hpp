#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "emulator/core/interval.hpp"
#include "reports/axis_span.hpp"
#include "reports/chart.hpp"

// What charts of QA share. Only those who draw them include it.

namespace gonio {

/// Where there is nothing to draw.
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// A group without rows would not be one for gnuplot.
[[nodiscard]] inline Rows or_gap(const Rows& rows, std::size_t columns) {
  return rows.empty() ? Rows{std::vector<double>(columns, gap)} : rows;
}

inline AxisSpan nothing_yet() {
  return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
}

/// With room on both sides; from 0 to 1 if nothing was included.
inline AxisSpan finished(const AxisSpan& span, double least) {
  return span.low <= span.high ? span.at_least(least).with_room() : AxisSpan{0.0, 1.0};
}

/// The limits that there are, a row each.
inline Rows limit_rows(const Interval& limits) {
  Rows rows;
  for (const std::optional<double>& limit : {limits.low, limits.high}) {
    if (limit) {
      rows.push_back({*limit});
    }
  }
  return rows;
}

/// The largest number of a column, 0 at least.
inline double highest(const Rows& rows, std::size_t column) {
  double high = 0.0;
  for (const auto& row : rows) {
    high = std::isfinite(row[column]) ? std::max(high, row[column]) : high;
  }
  return high;
}

}  // namespace gonio

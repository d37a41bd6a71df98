#include "reports/control_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "reports/chart_rows.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

double middle(const ChartPoint& point) { return 0.5 * (double(point.first) + double(point.last)); }

bool is_range(ControlPoints points) {
  using enum ControlPoints;
  return points == range || points == moving_range || points == runs_moving_range;
}

/// Of neighbours that stand together the one farther from the middle is what a rule saw.
double seen_value(const ControlChart& chart, const ChartPoint& point) {
  return point.highest - chart.centre > chart.centre - point.lowest ? point.highest : point.lowest;
}

/// Rows (number, value) by rule; a group without rows would not be one for gnuplot.
std::vector<Rows> signals_of(const ControlChart& chart) {
  std::vector<Rows> groups(western_electric_rules);
  for (const ControlSignal& signal : chart.first_signals) {
    const auto at = std::find_if(chart.shown.begin(), chart.shown.end(), [&](const auto& point) {
      return point.first <= signal.point && signal.point <= point.last;
    });
    if (at != chart.shown.end() && signal.rule >= 1 && signal.rule <= int(groups.size())) {
      groups[std::size_t(signal.rule) - 1].push_back(
          {double(signal.point), seen_value(chart, *at)});
    }
  }
  for (Rows& rows : groups) {
    rows = or_gap(rows, 2);
  }
  return groups;
}

/// How often each rule spoke; of ranges the first one alone is asked.
std::vector<std::string> keys_of(const ControlChart& chart, std::size_t rules) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < rules; ++i) {
    keys.push_back(fmt::format("{}: {}", rule_words(int(i) + 1), times_words(chart.signals[i])));
  }
  const std::uint64_t all =
      std::accumulate(chart.signals.begin(), chart.signals.end(), std::uint64_t(0));
  if (all > chart.first_signals.size() && !keys.empty()) {
    keys.back() += fmt::format("; marked are the first {} of all", chart.first_signals.size());
  }
  return keys;
}

/// The numbers of a chart, and what they span.
struct ChartNumbers {
  Rows points = {};
  bool is_thinned = false;
  AxisSpan x = {1.0, 1.0}, y = {0.0, 0.0};
};

ChartNumbers numbers_of(const ControlChart& chart, const Rows& limits) {
  ChartNumbers numbers;
  numbers.y = {chart.centre, chart.centre};
  for (const double value : {chart.lower, chart.upper}) {
    numbers.y.include(value);
  }
  for (const auto& row : limits) {
    numbers.y.include(row.front());
  }
  for (const ChartPoint& point : chart.shown) {
    numbers.points.push_back({middle(point), point.lowest, point.mean, point.highest});
    numbers.is_thinned = numbers.is_thinned || point.first != point.last;
    numbers.x.include(double(point.last));
    for (const double value : {point.lowest, point.highest}) {
      numbers.y.include(value);
    }
  }
  if (!std::isfinite(chart.centre)) {
    numbers.y = {0.0, 1.0};
  }
  constexpr double least = 1e-6;
  numbers.y = numbers.y.at_least(least).with_room().with_room();  // for the shapes of rules
  numbers.x = {numbers.x.low - 0.5, numbers.x.high + 0.5};
  return numbers;
}

}  // namespace

PageData control_figure(Figures& figures, const ControlChart& chart, ControlPoints points,
                        const std::string& caption, const Interval& limits) {
  const Rows lines = or_gap(limit_rows(limits), 1);
  const ChartNumbers numbers = numbers_of(chart, lines);
  const std::size_t rules = is_range(points) ? 1 : western_electric_rules;
  Chart picture("control");
  picture.set("x_low", numbers.x.low).set("x_high", numbers.x.high);
  picture.set("y_low", numbers.y.low).set("y_high", numbers.y.high);
  picture.set("centre", chart.centre).set("lower", chart.lower).set("upper", chart.upper);
  picture.set("sigma", is_range(points) || !std::isfinite(chart.sigma) ? 0.0 : chart.sigma);
  picture.set("thinned", numbers.is_thinned ? 1.0 : 0.0);
  picture.set("kind", double(int(points) + 1)).set("rules", double(rules));
  picture.block("points", {numbers.points}).block("signals", signals_of(chart));
  picture.block("limits", {lines});
  return figures.figure(picture, caption, keys_of(chart, rules));
}

}  // namespace gonio

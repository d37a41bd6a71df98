#include "reports/qa_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "reports/chart_rows.hpp"
#include "reports/control_figure.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// The normal distribution of the same mean and spread, as counts of bins.
Rows normal_rows(const ChannelSummary& channel, double width, const AxisSpan& x) {
  constexpr int steps = 120;
  Rows rows;
  const double s = channel.standard_deviation;
  const double n = double(std::accumulate(channel.histogram.counts.begin(),
                                          channel.histogram.counts.end(), std::uint64_t(0)));
  for (int i = 0; s > 0.0 && i <= steps; ++i) {
    const double value = x.low + (x.high - x.low) * i / steps;
    const double z = (value - channel.mean) / s;
    rows.push_back(
        {value, n * width / (s * std::sqrt(2.0 * std::numbers::pi)) * std::exp(-0.5 * z * z)});
  }
  return rows;
}

/// 1, 2 or 5 times a power of ten, at most so much.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return most >= 5.0 * power ? 5.0 * power : most >= 2.0 * power ? 2.0 * power : power;
}

/// Rows (x, y, length, width, deviation) of places that are known.
Rows spot_rows(const ChannelSummary& channel) {
  constexpr double point_mm = 2.0;  // to be seen
  const double mean = mean_of_positions(channel);
  const auto size = [&](const std::optional<double>& half) {
    return half && *half > 0.0 && std::isfinite(*half) ? 2.0 * *half : point_mm;
  };
  Rows rows;
  for (const PositionSummary& position : channel.positions) {
    if (position.x_mm && position.y_mm) {
      rows.push_back({*position.x_mm, *position.y_mm, size(position.half_length_mm),
                      size(position.half_width_mm), position.mean - mean});
    }
  }
  return rows;
}

Rows panel_edge(const QaResult& result) {
  const double length = result.panel_length_mm;
  const double width = result.panel_width_mm;
  return length > 0.0 && width > 0.0
             ? Rows{{0.0, 0.0}, {length, 0.0}, {length, width}, {0.0, width}, {0.0, 0.0}}
             : Rows();
}

std::string size_words(const QaResult& result) {
  return result.panel_length_mm > 0.0 && result.panel_width_mm > 0.0
             ? fmt::format("Panel of {:g} mm by {:g} mm", result.panel_length_mm,
                           result.panel_width_mm)
             : "Panel whose edge is not known";
}

PageData chart_of(Figures& figures, const ChannelSummary& channel, const ControlChart& chart,
                  ControlPoints points, const char* name) {
  return control_figure(
      figures, chart, points,
      fmt::format("{}, {}{}: {}. Solid line: centre; dashed: control limits{}", name,
                  channel_words(channel.channel), in_unit(channel.channel),
                  control_words(chart, "panel"),
                  points == ControlPoints::range || points == ControlPoints::moving_range
                      ? ""
                      : "; shades: zones of one sigma"));
}

}  // namespace

PageList control_figures(Figures& figures, const ChannelSummary& channel) {
  using enum ControlPoints;
  const ControlCharts::Result& charts = channel.charts;
  PageList list;
  if (charts.mean) {
    list.push_back(chart_of(figures, channel, *charts.mean, x_bar, "X-bar chart"));
  }
  if (charts.range) {
    list.push_back(chart_of(figures, channel, *charts.range, range, "R chart"));
  }
  if (charts.individual.points > 0) {
    list.push_back(chart_of(figures, channel, charts.individual, individual, "I chart"));
  }
  if (charts.moving_range.points > 0) {
    list.push_back(chart_of(figures, channel, charts.moving_range, moving_range, "MR chart"));
  }
  return list;
}

PageData histogram_figure(Figures& figures, const ChannelSummary& channel) {
  const Histogram::Bins& bins = channel.histogram;
  const double U = channel.expanded_uncertainty;
  AxisSpan x = nothing_yet();
  x.include(bins.low);
  x.include(bins.low + bins.width * double(bins.counts.size()));
  const Rows limits = limit_rows(channel.limits);
  Rows guards;
  for (const auto& limit : limits) {
    x.include(limit.front() - U);
    x.include(limit.front() + U);
    if (U > 0.0) {
      guards.push_back({limit.front() - U, limit.front() + U});
    }
  }
  x = finished(x, 1e-3);
  const double width = bins.width > 0.0 ? bins.width : 0.02 * (x.high - x.low);
  Rows rows;
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    const double middle = bins.width > 0.0 ? bins.low + (double(i) + 0.5) * width : bins.low;
    rows.push_back({middle, double(bins.counts[i]), width});
  }
  const Rows normal = normal_rows(channel, width, x);
  const double most = std::max({1.0, highest(rows, 1), highest(normal, 1)});
  std::vector<std::string> keys{"panels", "normal distribution of the same mean and s", "limits",
                                "U about the limits"};
  keys.resize(limits.empty() ? 2 : guards.empty() ? 3 : 4);
  Chart picture("histogram");
  picture.set("x_low", x.low).set("x_high", x.high).set("y_high", 1.08 * most);
  picture.set("names", double(keys.size()));
  picture.block("bins", {or_gap(rows, 3)}).block("normal", {or_gap(normal, 2)});
  picture.block("limits", {or_gap(limits, 1)}).block("guards", {or_gap(guards, 2)});
  return figures.figure(
      picture,
      fmt::format("Means of panels, {}{}; limits: {}", channel_words(channel.channel),
                  in_unit(channel.channel), typeset(limits_words(channel))),
      keys);
}

bool has_places(const ChannelSummary& channel) { return !spot_rows(channel).empty(); }

PageData panel_figure(Figures& figures, const QaResult& result, const ChannelSummary& channel) {
  const Rows spots = spot_rows(channel);
  const Rows edge = panel_edge(result);
  AxisSpan x = nothing_yet();
  AxisSpan y = nothing_yet();
  double most = 1e-6;
  for (const auto& spot : spots) {
    x.include(spot[0] - 0.5 * spot[2]);
    x.include(spot[0] + 0.5 * spot[2]);
    y.include(spot[1] - 0.5 * spot[3]);
    y.include(spot[1] + 0.5 * spot[3]);
    most = std::isfinite(spot[4]) ? std::max(most, std::abs(spot[4])) : most;
  }
  for (const auto& corner : edge) {
    x.include(corner[0]);
    y.include(corner[1]);
  }
  constexpr double least_mm = 10.0;
  x = finished(x, least_mm);
  y = finished(y, least_mm);
  const double foot = 0.12 * std::max(y.high - y.low, 0.5 * (x.high - x.low));  // of the scale bar
  const double bar = round_length((x.high - x.low) / 4.0);
  Chart picture("panel_map");
  picture.set("x_low", x.low).set("x_high", x.high);
  picture.set("y_low", y.low - foot).set("y_high", y.high).set("most", most);
  picture.set("decimals", double(decimals_of(most)));
  picture.set("bar", bar).set("bar_x", x.low + 0.05 * (x.high - x.low));
  picture.set("bar_y", y.low - 0.45 * foot);
  picture.block("spots", {or_gap(spots, 5)}).block("panel", {or_gap(edge, 2)});
  return figures.figure(
      picture,
      fmt::format("{}, {}: what is read at each place more (+) or less (-) than on all{}, "
                  "to scale; ellipses: the measuring spots",
                  size_words(result), channel_words(channel.channel), in_unit(channel.channel)),
      {});
}

}  // namespace gonio

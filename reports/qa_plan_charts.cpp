#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "reports/chart_rows.hpp"
#include "reports/qa_charts.hpp"
#include "reports/qa_words.hpp"

// Charts of what judges, not of what is judged: the gauge and the plan.

namespace gonio {

namespace {

constexpr double percent = 100.0;

std::vector<double> row_of(double x, const Estimate& share) {
  return {x, percent * share.value, percent * share.low, percent * share.high};
}

/// A chart of risks over what may be chosen, and what is drawn beside them.
struct RiskChart {
  std::vector<Rows> risks = {};
  double asked = 0.0, present = 0.0;
  std::optional<double> answer = {};
  int kind = 1;

  [[nodiscard]] Chart chart() const {
    AxisSpan x = nothing_yet();
    double most = percent * asked;
    for (const Rows& rows : risks) {
      for (const auto& row : rows) {
        x.include(row.front());
      }
      most = std::max(most, highest(rows, 3));
    }
    x.include(present);
    x.include(answer.value_or(gap));
    x = finished(x, 1e-9);
    constexpr double room = 1.08;
    Chart picture("risks");
    picture.set("x_low", x.low).set("x_high", x.high).set("y_high", most > 0.0 ? room * most : 1.0);
    picture.set("count", double(risks.size())).set("asked", percent * asked);
    picture.set("kind", kind).set("answered", answer ? 1.0 : 0.0);
    std::vector<Rows> groups;
    for (const Rows& rows : risks) {
      groups.push_back(or_gap(rows, 4));
    }
    picture.block("risks", groups).block("marks", {{{present}}, {{answer.value_or(gap)}}});
    return picture;
  }
};

}  // namespace

PageData gauge_figure(Figures& figures, const QaResult& result, const ChannelGauge& gauge) {
  constexpr std::size_t shown = 6;  // without all of them together
  std::vector<Rows> groups(gauge.study.percent_of_tolerance ? 2 : 1);
  double most = 0.0;
  const auto components = gauge_components(gauge.study);
  for (std::size_t i = 0; i < shown; ++i) {
    groups[0].push_back({double(i + 1), components[i].percent_of_study});
    if (groups.size() > 1) {
      groups[1].push_back({double(i + 1), components[i].percent_of_tolerance.value_or(gap)});
    }
  }
  std::vector<std::string> keys{"share of the standard deviation of the study"};
  for (const Rows& rows : groups) {
    most = std::max(most, highest(rows, 1));
  }
  if (groups.size() > 1) {
    keys.emplace_back("6 standard deviations as a share of the tolerance");
  }
  Chart picture("gauge");
  picture.set("count", double(groups.size())).set("x_high", most > 0.0 ? 1.2 * most : 1.0);
  picture.block("shares", groups).block("bounds", {{{10.0}, {30.0}}});
  return figures.figure(
      picture,
      fmt::format("Gauge R&R, {}: {}. Dashed: 10 % and 30 %",
                  channel_words(channel_at(result, gauge.channel)), gauge_words(gauge.study)),
      keys);
}

PageData curve_figure(Figures& figures, const QaResult& result, const OcCurve& curve) {
  Rows simulated;
  Rows exact;
  AxisSpan x = nothing_yet();
  for (const OcPoint& point : curve.points) {
    simulated.push_back(row_of(point.mean, point.accepted));
    exact.push_back({point.mean, percent * point.exact.value_or(gap)});
    x.include(point.mean);
  }
  const auto by_mean = [](const auto& a, const auto& b) { return a.front() < b.front(); };
  std::stable_sort(simulated.begin(), simulated.end(), by_mean);
  std::stable_sort(exact.begin(), exact.end(), by_mean);
  x.include(curve.present_mean);
  x = finished(x, 1e-3);
  Rows limits;
  if (curve.channel < result.channels.size()) {
    for (const auto& row : limit_rows(result.channels[curve.channel].limits)) {
      if (row.front() >= x.low && row.front() <= x.high) {
        limits.push_back(row);
      }
    }
  }
  const BatchChannel channel = channel_at(result, curve.channel);
  Chart picture("operating_characteristic");
  picture.set("x_low", x.low).set("x_high", x.high);
  picture.block("simulated", {or_gap(simulated, 4)}).block("exact", {or_gap(exact, 2)});
  picture.block("limits", {or_gap(limits, 1)}).block("present", {{{curve.present_mean}}});
  return figures.figure(
      picture,
      fmt::format("Operating characteristic, {}{}: lots accepted while {} moves their mean",
                  channel_words(channel), in_unit(channel), parameter_words(curve.parameter)),
      {fmt::format("simulated, {} for each point; bars: 95 % limits",
                   count_text(curve.lots, "lot")),
       curve.closed_form.empty()
           ? "no closed form is known"
           : fmt::format("{}, {}", closed_form_words(curve), curve.closed_form),
       "limits of the specification", "mean now"});
}

PageData answer_figure(Figures& figures, const ReadingsAnswer& answer) {
  RiskChart chart{.risks = {{}, {}}, .asked = answer.risk, .present = double(answer.present)};
  if (answer.needed) {
    chart.answer = double(*answer.needed);
  }
  for (const ReadingsAnswer::Row& row : answer.rows) {
    chart.risks[0].push_back(row_of(double(row.readings), row.producer));
    chart.risks[1].push_back(row_of(double(row.readings), row.consumer));
  }
  std::vector<std::string> keys{"producer's risk", "consumer's risk", "risk asked for", "now"};
  if (answer.needed) {
    keys.emplace_back("answer");
  }
  return figures.figure(chart.chart(),
                        "Risks of a lot by the number of readings of a panel; bars: 95 % limits",
                        keys);
}

PageData answer_figure(Figures& figures, const SpreadAnswer& answer) {
  const double scale = parameter_scale(answer.parameter);
  RiskChart chart{.risks = {{}},
                  .asked = answer.risk,
                  .present = scale * answer.present,
                  .kind = scale == 1.0 ? 3 : 2};
  if (answer.allowed) {
    chart.answer = scale * *answer.allowed;
  }
  for (const SpreadAnswer::Row& row : answer.rows) {
    chart.risks[0].push_back(row_of(scale * row.spread, row.refused));
  }
  std::vector<std::string> keys{"lots refused", "share asked for", "now"};
  if (answer.allowed) {
    keys.emplace_back("answer");
  }
  return figures.figure(chart.chart(),
                        fmt::format("Lots refused by the spread of {}; bars: 95 % limits",
                                    parameter_words(answer.parameter)),
                        keys);
}

}  // namespace gonio

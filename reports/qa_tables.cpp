#include "reports/qa_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/qa_words.hpp"

namespace gonio {

namespace {

std::string count(std::uint64_t number) { return fmt::format("{}", number); }

/// A component of a spread; "-" where nothing tells it.
std::string component(double sd, std::uint64_t freedom) {
  return freedom > 0 ? spread_text(sd) : "-";
}

void add_anova(ReportTable& table, const char* name, const AnovaRow& row) {
  const auto text = [](const std::optional<double>& number) {
    return number && std::isfinite(*number) ? fmt::format("{:.3g}", *number) : "-";
  };
  constexpr double tiny_p = 1e-4;
  table.rows.push_back({name, count(row.degrees_of_freedom), text(row.sum_of_squares),
                        text(row.mean_square), text(row.f),
                        row.p && *row.p < tiny_p ? "< 0.0001" : text(row.p)});
}

std::string place_text(const std::optional<double>& mm) {
  return mm && std::isfinite(*mm) ? fixed_text(*mm, 1) : "-";
}

}  // namespace

ReportTable channel_table(const QaResult& result) {
  ReportTable table{
      .caption =
          "Means of panels against the limits; R: range of its readings; rejected: by the "
          "reading rule of the standard",
      .heads = {"Channel", "Limits", ">U", ">Mean", ">s", ">Lowest", ">Highest", ">Mean R", ">Pass",
                ">Fail", ">Inconclusive", ">Rejected"}};
  for (const ChannelSummary& channel : result.channels) {
    const double s = channel.standard_deviation;
    const auto value = [&](double x) { return channel.panels > 0 ? value_text(x, s) : "-"; };
    table.rows.push_back({channel_words(channel.channel), limits_words(channel),
                          spread_text(channel.expanded_uncertainty), value(channel.mean),
                          channel.panels > 1 ? spread_text(s) : "-", value(channel.lowest),
                          value(channel.highest), spread_text(channel.mean_range),
                          count(channel.passed), count(channel.failed), count(channel.inconclusive),
                          count(rejected_by_rule(channel))});
  }
  return table;
}

ReportTable capability_table(const QaResult& result) {
  ReportTable table{.caption = "Capability of panel means, with 95 % limits",
                    .heads = {"Channel", ">Cp", ">Cpk", ">Pp", ">Ppk", ">Expected beyond"}};
  for (const ChannelSummary& channel : result.channels) {
    const Capability c = channel.capability.value_or(Capability{});
    table.rows.push_back({channel_words(channel.channel), index_text(c.cp), index_text(c.cpk),
                          index_text(c.pp), index_text(c.ppk),
                          channel.capability ? share_text(c.expected_beyond) : "-"});
  }
  return table;
}

ReportTable spread_table(const QaResult& result) {
  ReportTable table{.caption = "Where the spread comes from: standard deviations",
                    .heads = {"Channel", ">Lots", ">Degrees of freedom", ">Panels",
                              ">Degrees of freedom", ">Readings", ">Degrees of freedom"}};
  for (const ChannelSummary& channel : result.channels) {
    const NestedSpread& spread = channel.spread;
    table.rows.push_back(
        {channel_words(channel.channel), component(spread.sd_lots, spread.freedom_lots),
         count(spread.freedom_lots), component(spread.sd_panels, spread.freedom_panels),
         count(spread.freedom_panels), component(spread.sd_readings, spread.freedom_readings),
         count(spread.freedom_readings)});
  }
  return table;
}

ReportTable control_table(const QaResult& result) {
  ReportTable table{.caption = "Control charts by the Western Electric rules; a point is a panel",
                    .heads = {"Chart", ">Points", ">Lower", ">Centre", ">Upper", "Finding"}};
  for (const ChannelSummary& channel : result.channels) {
    for (const NamedChart& named : named_charts(channel.charts)) {
      const ControlChart& chart = *named.chart;
      const auto value = [&](double x) { return value_text(x, (chart.upper - chart.lower) / 6.0); };
      table.rows.push_back({fmt::format("{}, {}", named.name, channel_words(channel.channel)),
                            count(chart.points), value(chart.lower), value(chart.centre),
                            value(chart.upper), control_words(chart, "panel")});
    }
  }
  return table;
}

ReportTable lot_table(const QaResult& result, std::size_t most) {
  const std::uint64_t all = std::max<std::uint64_t>(
      result.lots_accepted + result.lots_refused + result.lots_inconclusive, result.lots.size());
  const std::size_t shown = std::min(most, result.lots.size());
  ReportTable table{
      .caption = shown < all ? fmt::format("Lots, the first {} of {}", shown, all) : "Lots",
      .heads = {">Lot", "Verdict", ">Panels", ">Not conforming", ">Inconclusive", ">Not uniform"}};
  for (const ChannelSummary& channel : result.channels) {
    table.heads.push_back(fmt::format(">Mean, {}", channel_words(channel.channel)));
  }
  for (std::size_t i = 0; i < shown; ++i) {
    const LotSummary& lot = result.lots[i];
    std::vector<ReportCell> row{count(lot.number),       lot.verdict,
                                count(lot.panels),       count(lot.nonconforming),
                                count(lot.inconclusive), count(lot.not_uniform)};
    for (std::size_t c = 0; c < result.channels.size(); ++c) {
      row.emplace_back(c < lot.mean.size()
                           ? value_text(lot.mean[c], result.channels[c].standard_deviation)
                           : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

ReportTable gauge_table(const QaResult& result, const ChannelGauge& gauge) {
  ReportTable table{.caption = fmt::format("Gauge R&R, {}: {} by {}, {} each",
                                           channel_words(channel_at(result, gauge.channel)),
                                           count_text(gauge.panels, "panel"),
                                           count_text(gauge.appraisers.size(), "appraiser"),
                                           count_text(gauge.repetitions, "reading")),
                    .heads = {"Component", ">s", ">Share of study", ">Share of tolerance"}};
  for (const GaugeComponent& part : gauge_components(gauge.study)) {
    table.rows.push_back({part.name, spread_text(part.sd), percent_text(part.percent_of_study),
                          percent_text(part.percent_of_tolerance)});
  }
  return table;
}

ReportTable anova_table(const QaResult& result, const ChannelGauge& gauge) {
  const GaugeStudy& study = gauge.study;
  ReportTable table{
      .caption =
          fmt::format("Analysis of variance, {}", channel_words(channel_at(result, gauge.channel))),
      .heads = {"Source", ">Degrees of freedom", ">Sum of squares", ">Mean square", ">F", ">p"}};
  add_anova(table, "panels", study.part);
  add_anova(table, "appraisers", study.appraiser);
  add_anova(table, "interaction", study.interaction);
  add_anova(table, "repeatability", study.repeatability);
  add_anova(table, "all", study.total);
  return table;
}

ReportTable risk_table(const Risks& risks) {
  ReportTable table{
      .caption = fmt::format("Risks with 95 % limits. {}", risk_words(risks)),
      .heads = {"Of a", ">Conform", ">Accepted", ">Producer's risk", ">Consumer's risk"}};
  const auto add = [&](const char* of, const RiskSummary& risk) {
    table.rows.push_back({of, share_text(risk.conforming.value), share_text(risk.accepted.value),
                          share_text(risk.producer), share_text(risk.consumer)});
  };
  add("lot", risks.lot);
  add("panel", risks.panel);
  if (risks.panel_normal) {
    table.rows.push_back({"panel, normal model", "-", "-", share_text(risks.panel_normal->producer),
                          share_text(risks.panel_normal->consumer)});
  }
  return table;
}

ReportTable curve_table(const QaResult& result, const OcCurve& curve, std::size_t most) {
  const BatchChannel channel = channel_at(result, curve.channel);
  ReportTable table{.caption = fmt::format(
                        "Operating characteristic, {}: lots accepted, with 95 % limits, while {} "
                        "moves; true mean "
                        "now {}",
                        channel_words(channel), parameter_words(curve.parameter),
                        number_text(std::round(100.0 * curve.present_mean) / 100.0, channel.unit)),
                    .heads = {">True mean", ">Panels beyond", ">Lots accepted",
                              fmt::format(">{}", closed_form_words(curve))}};
  const std::size_t n = curve.points.size();
  const std::size_t rows = std::min(most, n);
  for (std::size_t i = 0; i < rows; ++i) {
    const OcPoint& point = curve.points[rows < 2 ? 0 : i * (n - 1) / (rows - 1)];
    table.rows.push_back({number_text(std::round(100.0 * point.mean) / 100.0),
                          share_text(point.beyond), share_text(point.accepted),
                          share_text(point.exact)});
  }
  return table;
}

ReportTable answer_table(const ReadingsAnswer& answer) {
  ReportTable table{.caption = "Risks of a lot by the readings of a panel, with 95 % limits",
                    .heads = {">Readings", ">Producer's risk", ">Consumer's risk"}};
  for (const ReadingsAnswer::Row& row : answer.rows) {
    const bool is_answer = row.readings == answer.needed;
    const bool is_present = row.readings == answer.present;
    table.rows.push_back({fmt::format("{}{}", row.readings,
                                      is_answer && is_present ? " (enough, as now)"
                                      : is_answer             ? " (enough)"
                                      : is_present            ? " (now)"
                                                              : ""),
                          share_text(row.producer), share_text(row.consumer)});
  }
  return table;
}

ReportTable answer_table(const SpreadAnswer& answer) {
  ReportTable table{
      .caption = fmt::format("Lots refused by the spread of {}, with 95 % limits; now {}",
                             parameter_words(answer.parameter),
                             parameter_text(answer.parameter, answer.present)),
      .heads = {">Standard deviation", ">Lots refused", ">Panels beyond the limits"}};
  for (const SpreadAnswer::Row& row : answer.rows) {
    table.rows.push_back({parameter_text(answer.parameter, row.spread), share_text(row.refused),
                          share_text(row.beyond)});
  }
  return table;
}

ReportTable position_table(const ChannelSummary& channel) {
  ReportTable table{
      .caption = fmt::format("Positions on the panel, {}", channel_words(channel.channel)),
      .heads = {">Position", ">x / mm", ">y / mm", ">Readings", ">Mean", ">Deviation", ">s"}};
  const double mean = mean_of_positions(channel);
  for (const PositionSummary& position : channel.positions) {
    const double s = position.standard_deviation;
    table.rows.push_back({count(position.position), place_text(position.x_mm),
                          place_text(position.y_mm), count(position.readings),
                          value_text(position.mean, s), signed_text(position.mean - mean, 3),
                          position.readings > 1 ? spread_text(s) : "-"});
  }
  return table;
}

ReportTable file_table(const RunRecord& run) {
  ReportTable table{.caption = "Files that the run rests on", .heads = {"File", "What", "SHA-256"}};
  const auto add = [&](const HashedFile& file, const char* what) {
    if (!file.name.empty()) {
      table.rows.push_back({file.name, what, file.sha256});
    }
  };
  add(run.sample, "sample");
  add(run.readings, "measured readings");
  for (const HashedFile& instrument : run.instruments) {
    add(instrument, "instrument");
  }
  return table;
}

}  // namespace gonio

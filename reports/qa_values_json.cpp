#include "reports/qa_values_json.hpp"

#include <array>

namespace gonio {

namespace {

using nlohmann::ordered_json;

const char* kind_name(BatchChannel::Kind kind) {
  constexpr std::array names{"gloss", "colour_difference", "haze"};
  return names.at(static_cast<std::size_t>(kind));
}

ordered_json json_of(const HashedFile& file) {
  return file.name.empty() ? ordered_json(nullptr)
                           : ordered_json{{"name", file.name}, {"sha256", file.sha256}};
}

ordered_json json_of(const std::optional<Capability>& capability) {
  using gonio::json_of;
  if (!capability) {
    return nullptr;
  }
  return {{"cp", json_of(capability->cp)},
          {"cpk", json_of(capability->cpk)},
          {"pp", json_of(capability->pp)},
          {"ppk", json_of(capability->ppk)},
          {"expected_beyond", capability->expected_beyond}};
}

ordered_json json_of(const NestedSpread& spread) {
  return {{"mean", spread.mean},
          {"sd_lots", spread.sd_lots},
          {"sd_panels", spread.sd_panels},
          {"sd_readings", spread.sd_readings},
          {"freedom_lots", spread.freedom_lots},
          {"freedom_panels", spread.freedom_panels},
          {"freedom_readings", spread.freedom_readings}};
}

ordered_json json_of(const Histogram::Bins& bins) {
  return {{"low", bins.low}, {"width", bins.width}, {"counts", bins.counts}};
}

ordered_json json_of(const ControlSignal& signal) {
  return {{"point", signal.point}, {"rule", signal.rule}};
}

ordered_json json_of(const ChartPoint& point) {
  return {{"first", point.first},
          {"last", point.last},
          {"lowest", point.lowest},
          {"mean", point.mean},
          {"highest", point.highest}};
}

ordered_json json_of(const PositionSummary& position) {
  using gonio::json_of;
  return {{"position", position.position},
          {"x_mm", json_of(position.x_mm)},
          {"y_mm", json_of(position.y_mm)},
          {"half_length_mm", json_of(position.half_length_mm)},
          {"half_width_mm", json_of(position.half_width_mm)},
          {"readings", position.readings},
          {"mean", position.mean},
          {"sd", position.standard_deviation}};
}

/// Of types of this file too.
template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
  ordered_json list = ordered_json::array();
  for (const Item& item : items) {
    list.push_back(json_of(item));
  }
  return list;
}

ordered_json json_of(const AnovaRow& row) {
  using gonio::json_of;
  return {{"sum_of_squares", row.sum_of_squares},
          {"degrees_of_freedom", row.degrees_of_freedom},
          {"mean_square", row.mean_square},
          {"f", json_of(row.f)},
          {"p", json_of(row.p)}};
}

ordered_json uniformity_of(const ChannelSummary& channel) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 0; i < channel.uniformity.size(); ++i) {
    json[panel_verdict_names[i]] = channel.uniformity[i];
  }
  return json;
}

}  // namespace

ordered_json json_of(const Interval& limits) {
  return {{"low", json_of(limits.low)}, {"high", json_of(limits.high)}};
}

ordered_json json_of(const BatchChannel& channel) {
  return {{"id", channel.id},
          {"geometry", channel.geometry},
          {"kind", kind_name(channel.kind)},
          {"unit", channel.unit}};
}

ordered_json json_of(const RunRecord& run) {
  return {{"id", run.id},
          {"kind", run_kind_name(run.kind)},
          {"batch", run.batch},
          {"title", run.title},
          {"batch_file", run.batch_file},
          {"fingerprint", run.fingerprint},
          {"seed", run.seed},
          {"gonio_version", run.gonio_version},
          {"standard", run.standard},
          {"sample", json_of(run.sample)},
          {"readings", json_of(run.readings)},
          {"instruments", list_of(run.instruments)},
          {"operators", run.operators},
          {"channels", json_list(run.channels)},
          {"lots", run.lots},
          {"panels", run.panels},
          {"gauge_panels", run.gauge_panels},
          {"started", run.started}};
}

ordered_json json_of(const ControlChart& chart) {
  return {{"centre", chart.centre},
          {"lower", chart.lower},
          {"upper", chart.upper},
          {"sigma", chart.sigma},
          {"points", chart.points},
          {"in_control", chart.in_control()},
          {"signals_by_rule", chart.signals},
          {"first_signals", list_of(chart.first_signals)},
          {"shown", list_of(chart.shown)}};
}

ordered_json json_of(const ControlCharts::Result& charts) {
  const auto chart = [](const std::optional<ControlChart>& one) {
    return one ? json_of(*one) : ordered_json(nullptr);
  };
  return {{"subgroup_size", charts.subgroup_size},
          {"baseline", charts.baseline},
          {"x_bar", chart(charts.mean)},
          {"r", chart(charts.range)},
          {"individual", json_of(charts.individual)},
          {"moving_range", json_of(charts.moving_range)}};
}

ordered_json json_of(const ChannelSummary& channel) {
  return {{"channel", json_of(channel.channel)},
          {"limits", json_of(channel.limits)},
          {"target", json_of(channel.target)},
          {"expanded_uncertainty", channel.expanded_uncertainty},
          {"panels", channel.panels},
          {"readings", channel.readings},
          {"mean", channel.mean},
          {"sd", channel.standard_deviation},
          {"lowest", channel.lowest},
          {"highest", channel.highest},
          {"mean_range", channel.mean_range},
          {"spread", json_of(channel.spread)},
          {"capability", json_of(channel.capability)},
          {"passed", channel.passed},
          {"failed", channel.failed},
          {"inconclusive", channel.inconclusive},
          {"uniformity", uniformity_of(channel)},
          {"charts", json_of(channel.charts)},
          {"histogram", json_of(channel.histogram)},
          {"positions", list_of(channel.positions)}};
}

ordered_json json_of(const ChannelGauge& gauge, const BatchChannel& channel) {
  const GaugeStudy& study = gauge.study;
  return {{"channel", channel.id},
          {"appraisers", gauge.appraisers},
          {"panels", gauge.panels},
          {"repetitions", gauge.repetitions},
          {"anova",
           {{"part", json_of(study.part)},
            {"appraiser", json_of(study.appraiser)},
            {"interaction", json_of(study.interaction)},
            {"repeatability", json_of(study.repeatability)},
            {"total", json_of(study.total)}}},
          {"interaction_pooled", study.interaction_pooled},
          {"sd_repeatability", study.sd_repeatability},
          {"sd_repeatability_interval", json_of(study.repeatability_interval)},
          {"sd_appraiser", study.sd_appraiser},
          {"sd_interaction", study.sd_interaction},
          {"sd_reproducibility", study.sd_reproducibility},
          {"sd_gauge", study.sd_gauge},
          {"sd_part", study.sd_part},
          {"sd_total", study.sd_total},
          {"percent_of_study", study.percent_of_study},
          {"percent_of_tolerance", json_of(study.percent_of_tolerance)},
          {"percent_contribution", study.percent_contribution},
          {"distinct_categories", study.distinct_categories}};
}

}  // namespace gonio

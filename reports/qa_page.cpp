#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/escape.hpp"
#include "reports/page_verdict.hpp"
#include "reports/qa_charts.hpp"
#include "reports/qa_report.hpp"
#include "reports/qa_tables.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

constexpr std::size_t all_rows = 1000;

void add_fact(PageList& list, const char* name, const std::string& value) {
  if (!value.empty()) {
    PageData data("name", name);
    data.set("value", typeset(value));
    list.push_back(data);
  }
}

PageList facts(const QaResult& result) {
  const RunRecord& run = result.run;
  PageList list;
  add_fact(list, "Standard", run.standard);
  add_fact(list, "Readings",
           run.kind == RunRecord::Kind::simulated
               ? "simulated: no panel was sprayed"
               : fmt::format("measured, from {}", run.readings.name));
  add_fact(list, "Extent", extent_words(result));
  add_fact(list, "Decision rule", result.decision);
  add_fact(list, "Acceptance", result.acceptance);
  for (const std::string& sentence : answers(result)) {
    add_fact(list, "Answer", sentence);
  }
  return list;
}

PageList provenance(const QaResult& result, const std::string& version) {
  const RunRecord& run = result.run;
  PageList list;
  add_fact(list, "Run",
           fmt::format("{} in {}", run.id, result.store.empty() ? "no store" : result.store));
  add_fact(list, "Started", run.started);
  add_fact(list, "Batch file", run.batch_file);
  add_fact(list, "Fingerprint", run.fingerprint);
  add_fact(list, "Seed", fmt::format("{}", run.seed));
  add_fact(list, "Computed by", run.gonio_version.empty() ? "" : "gonio " + run.gonio_version);
  add_fact(list, "Page written by", version.empty() ? "" : "gonio " + version);
  add_fact(list, "Operators", fmt::format("{}", fmt::join(run.operators, ", ")));
  if (result.surrogate_error > 0.0) {
    add_fact(list, "Polynomials for the optics",
             fmt::format("largest error seen {}", spread_text(result.surrogate_error)));
  }
  return list;
}

PageList overview(const QaResult& result) {
  PageList tables;
  if (!result.channels.empty()) {
    tables.push_back(table_data(channel_table(result)));
    tables.push_back(table_data(capability_table(result)));
    tables.push_back(table_data(spread_table(result)));
  }
  if (const ReportTable control = control_table(result); !control.rows.empty()) {
    tables.push_back(table_data(control));
  }
  if (!result.lots.empty()) {
    tables.push_back(table_data(lot_table(result, all_rows)));
  }
  return tables;
}

std::string found_words(const ChannelSummary& channel) {
  const double s = channel.standard_deviation;
  return channel.panels == 0
             ? "No panel was read"
             : fmt::format("Mean {}, s {}, from {} to {} over {}", value_text(channel.mean, s),
                           spread_text(s), value_text(channel.lowest, s),
                           value_text(channel.highest, s), count_text(channel.panels, "panel"));
}

PageData channel_data(Figures& figures, const QaResult& result, std::size_t number) {
  const ChannelSummary& channel = result.channels[number];
  PageData data("words", capitalised(channel_words(channel.channel)));
  data.set("anchor", anchor("channel", channel.channel.id));
  data.set("is_main", PageData(number == result.main_channel && result.channels.size() > 1 &&
                               channel.capability.has_value()));
  data.set("limits", typeset(limits_words(channel)));
  data.set("found", found_words(channel));
  data.set("histogram",
           channel.histogram.counts.empty() ? PageData(false) : histogram_figure(figures, channel));
  set_list(data, "charts", control_figures(figures, channel));
  data.set("map", has_places(channel) ? panel_figure(figures, result, channel) : PageData(false));
  data.set("place_table",
           channel.positions.empty() ? PageData(false) : table_data(position_table(channel)));
  return data;
}

PageData gauge_data(Figures& figures, const QaResult& result, const ChannelGauge& gauge) {
  PageData data(
      "sentence",
      fmt::format("The gauge is {}; it tells {} apart.", gauge_words(gauge.study),
                  gauge.study.distinct_categories == 1
                      ? "no categories of panels"
                      : fmt::format("{} categories of panels", gauge.study.distinct_categories)));
  const auto& interval = gauge.study.repeatability_interval;
  data.set(
      "interval",
      fmt::format("{}{}",
                  interval ? fmt::format("Repeatability, 95 % limits: {} to {}.",
                                         spread_text(interval->low), spread_text(interval->high))
                           : "",
                  gauge.study.interaction_pooled
                      ? " The interaction of appraisers and panels is pooled with it."
                      : ""));
  set_text(data, "appraisers", fmt::format("{}", fmt::join(gauge.appraisers, "; ")));
  data.set("gauge_chart", gauge_figure(figures, result, gauge));
  data.set("gauge_table", table_data(gauge_table(result, gauge)));
  data.set("anova_table", table_data(anova_table(result, gauge)));
  return data;
}

template <class Answer>
PageData answer_data(Figures& figures, const Answer& answer) {
  PageData data("sentence", answer_words(answer));
  const bool has_rows = !answer.rows.empty();
  data.set("answer_chart", has_rows ? answer_figure(figures, answer) : PageData(false));
  data.set("answer_table", has_rows ? table_data(answer_table(answer)) : PageData(false));
  return data;
}

void add_plan(PageData& data, Figures& figures, const QaResult& result) {
  PageList curves;
  PageList answers;
  for (const OcCurve& curve : result.oc_curves) {
    const bool has_points = !curve.points.empty();
    PageData one;
    one.set("curve_chart", has_points ? curve_figure(figures, result, curve) : PageData(false));
    one.set("curve_table",
            has_points ? table_data(curve_table(result, curve, all_rows)) : PageData(false));
    curves.push_back(one);
  }
  if (result.readings_answer) {
    answers.push_back(answer_data(figures, *result.readings_answer));
  }
  for (const SpreadAnswer& answer : result.spread_answers) {
    answers.push_back(answer_data(figures, answer));
  }
  data.set("risk_table", result.risks ? table_data(risk_table(*result.risks)) : PageData(false));
  set_list(data, "curves", curves);
  set_list(data, "answers", answers);
  data.set("has_plan", PageData(result.risks || !curves.empty() || !answers.empty()));
}

void add_head(PageData& data, const QaResult& result, const std::string& version) {
  const RunRecord& run = result.run;
  data.set("sheet_foot", css_text(fmt::format("Quality of batch {}, run {}", run.batch, run.id)));
  data.set("batch", run.batch);
  set_text(data, "batch_title", run.title);
  data.set("verdict", verdict_data(result.verdict));
  data.set("meaning", qa_meaning(result));
  data.set("lot_counts", lot_counts(result));
  data.set("panel_counts", panel_counts(result));
  data.set("rules", rules_words());
  set_list(data, "remarks", text_list(result.remarks));
  data.set("facts", PageData(facts(result)));
  data.set("provenance", PageData(provenance(result, version)));
  const ReportTable files = file_table(run);
  data.set("file_table", files.rows.empty() ? PageData(false) : table_data(files));
  set_list(data, "tables", overview(result));
}

}  // namespace

std::string qa_page(const QaResult& result, const std::string& version) {
  Figures figures;
  PageData data;
  add_head(data, result, version);
  PageList channels;
  for (std::size_t i = 0; i < result.channels.size(); ++i) {
    channels.push_back(channel_data(figures, result, i));
  }
  set_list(data, "channels", channels);
  PageList gauges;
  for (const ChannelGauge& gauge : result.gauge) {
    gauges.push_back(gauge_data(figures, result, gauge));
  }
  set_list(data, "gauges", gauges);
  add_plan(data, figures, result);
  return render_page(
      "qa", fmt::format("Quality of batch {}: {}", result.run.batch, verdict_words(result.verdict)),
      data);
}

}  // namespace gonio

#include <fmt/format.h>

#include "reports/escape.hpp"
#include "reports/qa_report.hpp"
#include "reports/qa_tables.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

std::string head(const QaResult& result, bool styled) {
  const std::string verdict = verdict_words(result.verdict);
  const RunRecord& run = result.run;
  return fmt::format(
      "{}: {}\n{}\n{}\n\n{} - {}\nby {}; {}: {}\ndecision rule: {}\nacceptance: {}\n",
      styled ? fmt::format("\033[1m{}\033[0m", verdict) : verdict, qa_meaning(result),
      lot_counts(result), panel_counts(result), one_line(run.batch), one_line(run.title),
      one_line(run.standard), run_kind_name(run.kind), extent_words(result),
      one_line(result.decision), one_line(result.acceptance));
}

std::string lines(const std::string& title, const std::vector<std::string>& sentences,
                  bool styled) {
  std::string text = sentences.empty() ? "" : heading_text(title, styled);
  for (const std::string& sentence : sentences) {
    text += fmt::format("  {}\n", one_line(sentence));
  }
  return text;
}

std::string gauge_text(const QaResult& result, const ChannelGauge& gauge, bool styled) {
  return table_text(gauge_table(result, gauge), styled) +
         fmt::format(
             "  {}; distinct categories: {}{}\n", gauge_words(gauge.study),
             gauge.study.distinct_categories,
             gauge.study.interaction_pooled ? "; interaction pooled with repeatability" : "");
}

}  // namespace

std::string qa_text(const QaResult& result, bool styled) {
  std::string text = head(result, styled);
  if (!result.channels.empty()) {
    text += table_text(channel_table(result), styled) +
            table_text(capability_table(result), styled) + table_text(spread_table(result), styled);
  }
  if (const ReportTable control = control_table(result); !control.rows.empty()) {
    text += table_text(control, styled) + fmt::format("  {}\n", rules_words());
  }
  if (!result.lots.empty()) {
    constexpr std::size_t most_lots = 20;
    text += table_text(lot_table(result, most_lots), styled);
  }
  for (const ChannelGauge& gauge : result.gauge) {
    text += gauge_text(result, gauge, styled);
  }
  if (result.risks) {
    text += table_text(risk_table(*result.risks), styled);
  }
  for (const OcCurve& curve : result.oc_curves) {
    constexpr std::size_t most_points = 9;
    text += table_text(curve_table(result, curve, most_points), styled);
  }
  text +=
      lines("What was asked", answers(result), styled) + lines("Remarks", result.remarks, styled);
  return text + fmt::format("\nrun {} in {}; seed {}\n", result.run.id,
                            result.store.empty() ? "no store" : one_line(result.store),
                            result.run.seed);
}

}  // namespace gonio

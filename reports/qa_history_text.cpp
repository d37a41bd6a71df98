#include <fmt/format.h>

#include <cmath>

#include "emulator/core/csv_cell.hpp"
#include "reports/escape.hpp"
#include "reports/qa_history.hpp"
#include "reports/qa_trends.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

std::string chart_line(const char* name, const ControlChart& chart) {
  const auto value = [&](double x) { return value_text(x, (chart.upper - chart.lower) / 6.0); };
  return fmt::format("  {} chart of the means: centre {}, limits {} to {}; {}\n", name,
                     value(chart.centre), value(chart.lower), value(chart.upper),
                     control_words(chart, "point"));
}

std::string trend_text(const Trend& trend, bool styled) {
  std::string text = table_text(trend_table(trend), styled);
  if (trend.charts) {
    text +=
        chart_line("I", trend.charts->individual) + chart_line("MR", trend.charts->moving_range);
  }
  return text;
}

/// One cell, whatever the text holds.
std::string cell(const std::string& text) { return csv_cell(one_line(text)); }

std::string cell(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? fmt::format("{}", *number) : "";
}

std::string run_cells(const StoredRun& run) {
  const RunRecord& record = run.record;
  const std::string begin =
      fmt::format("{},{},{},{},{},{},", record.id, cell(record.batch), cell(record.title),
                  run_kind_name(record.kind), cell(record.standard), cell(record.started));
  if (!run.outcome) {
    return begin + ",not_finished,,,,,";
  }
  const RunOutcome& outcome = *run.outcome;
  return begin + fmt::format("{},{},{},{},{},{},", cell(outcome.finished),
                             verdict_name(outcome.verdict), outcome.panels, outcome.readings,
                             cell(outcome.producer_risk), cell(outcome.consumer_risk));
}

std::string channel_cells(const RunRecord& record, const ChannelTrend& found) {
  const bool is_known = found.channel < record.channels.size();
  const BatchChannel channel = is_known ? record.channels[found.channel] : BatchChannel{};
  return fmt::format("{},{},{},{},{},{},{},{},{},{},", cell(channel.id), cell(channel.unit),
                     found.panels, found.readings, cell(std::optional(found.mean)),
                     cell(std::optional(found.standard_deviation)), cell(found.low),
                     cell(found.high), cell(found.cpk), cell(found.ppk));
}

}  // namespace

std::string history_text(const std::vector<StoredRun>& runs, const std::string& store,
                         bool styled) {
  std::string text = fmt::format("{}\nin {}\n", run_counts(runs), one_line(store));
  if (!runs.empty()) {
    text += table_text(run_table(runs), styled);
  }
  for (const Trend& trend : trends(runs)) {
    text += trend_text(trend, styled);
  }
  return text;
}

std::string history_csv(const std::vector<StoredRun>& runs) {
  std::string text =
      "run,batch,title,kind,standard,started,finished,verdict,run_panels,run_readings,"
      "producer_risk,consumer_risk,channel,unit,panels,readings,mean,sd,low,high,cpk,ppk,seed,"
      "fingerprint,gonio_version\n";
  for (const StoredRun& run : runs) {
    const RunRecord& record = run.record;
    const std::string begin = run_cells(run);
    const std::string end = fmt::format("{},{},{}\n", record.seed, cell(record.fingerprint),
                                        cell(record.gonio_version));
    if (!run.outcome || run.outcome->channels.empty()) {
      text += begin + ",,,,,,,,,," + end;
      continue;
    }
    for (const ChannelTrend& found : run.outcome->channels) {
      text += begin + channel_cells(record, found) + end;
    }
  }
  return text;
}

}  // namespace gonio

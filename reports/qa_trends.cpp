#include "reports/qa_trends.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/qa_words.hpp"

namespace gonio {

namespace {

Interval limits_of(const ChannelTrend& found) { return {found.low, found.high}; }

/// Whether a run belongs to a trend.
using BelongsTo = bool (*)(const Trend& trend, const RunRecord& run, const BatchChannel& channel,
                           const ChannelTrend& found);

bool is_of_batch(const Trend& trend, const RunRecord& run, const BatchChannel& channel,
                 const ChannelTrend& /*found*/) {
  return trend.batch == run.batch && trend.channel == channel;
}

bool has_same_limits(const Trend& trend, const RunRecord& run, const BatchChannel& channel,
                     const ChannelTrend& found) {
  return trend.standard == run.standard && trend.channel == channel &&
         trend.limits == limits_of(found) && (found.low || found.high);
}

std::vector<Trend> grouped(const std::vector<StoredRun>& runs, BelongsTo belongs_to) {
  std::vector<Trend> list;
  for (const StoredRun& run : runs) {
    if (!run.outcome) {
      continue;
    }
    for (const ChannelTrend& found : run.outcome->channels) {
      if (found.channel >= run.record.channels.size()) {
        continue;
      }
      const BatchChannel& channel = run.record.channels[found.channel];
      auto trend = std::find_if(list.begin(), list.end(), [&](const Trend& one) {
        return belongs_to(one, run.record, channel, found);
      });
      if (trend == list.end()) {
        list.push_back(
            {.batch = run.record.batch, .standard = run.record.standard, .channel = channel});
        trend = list.end() - 1;
      }
      trend->limits = limits_of(found);
      trend->points.push_back({&run, &found});
    }
  }
  return list;
}

std::size_t batches_of(const Trend& trend) {
  std::set<std::string> ids;
  for (const Trend::Point& point : trend.points) {
    ids.insert(point.run->record.batch);
  }
  return ids.size();
}

/// Limits rest on all runs that there are: they are few.
void add_charts(Trend& trend) {
  constexpr std::size_t least = 2;
  ControlCharts charts(std::max(least, trend.points.size()));
  std::size_t added = 0;
  for (const Trend::Point& point : trend.points) {
    if (std::isfinite(point.found->mean)) {
      charts.add(1, point.found->mean, 0.0);
      ++added;
    }
  }
  if (added >= least) {
    trend.charts = charts.result();
  }
}

std::string index_text(const std::optional<double>& index) {
  return index && std::isfinite(*index) ? fixed_text(*index, 2) : "-";
}

}  // namespace

std::vector<Trend> trends(const std::vector<StoredRun>& runs) {
  std::vector<Trend> list = grouped(runs, is_of_batch);
  std::stable_sort(list.begin(), list.end(), [&](const Trend& a, const Trend& b) {
    const auto first = [&](const Trend& trend) {
      return std::find_if(runs.begin(), runs.end(),
                          [&](const StoredRun& run) { return run.record.batch == trend.batch; });
    };
    return first(a) < first(b);
  });
  for (Trend& trend : grouped(runs, has_same_limits)) {
    if (batches_of(trend) > 1) {
      trend.batch.clear();
      list.push_back(trend);
    }
  }
  for (Trend& trend : list) {
    add_charts(trend);
  }
  return list;
}

std::string trend_words(const Trend& trend) {
  return trend.batch.empty()
             ? fmt::format("{} of all batches with the limits {}", channel_words(trend.channel),
                           limits_words(trend.limits, {}, trend.channel.unit))
             : fmt::format("{} of batch {}", channel_words(trend.channel), trend.batch);
}

std::string run_counts(const std::vector<StoredRun>& runs) {
  std::set<std::string> batches;
  for (const StoredRun& run : runs) {
    batches.insert(run.record.batch);
  }
  std::vector<std::string> parts;
  for (const ConformanceVerdict verdict : all_verdicts) {
    const auto count = std::count_if(runs.begin(), runs.end(), [&](const StoredRun& run) {
      return run.outcome && run.outcome->verdict == verdict;
    });
    if (count > 0) {
      parts.push_back(fmt::format("{} {}", count, verdict_words(verdict)));
    }
  }
  const auto open = std::count_if(runs.begin(), runs.end(),
                                  [](const StoredRun& run) { return !run.outcome.has_value(); });
  if (open > 0) {
    parts.push_back(fmt::format("{} not finished", open));
  }
  return fmt::format("{} of {} {}{}{}", count_text(runs.size(), "run"), batches.size(),
                     batches.size() == 1 ? "batch" : "batches", parts.empty() ? "" : ": ",
                     fmt::join(parts, ", "));
}

std::string time_text(const std::string& time) {
  constexpr std::size_t length = 20;  // YYYY-MM-DDThh:mm:ssZ
  return time.size() == length && time[10] == 'T'
             ? fmt::format("{} {}", time.substr(0, 10), time.substr(11, 5))
             : time;
}

ReportTable run_table(const std::vector<StoredRun>& runs) {
  ReportTable table{
      .caption = "Runs, the oldest first; times in UTC; risks: producer's and consumer's, of a lot",
      .heads = {">Run", "Batch", "Started", "Kind", "Verdict", ">Panels", ">Readings", ">Producer",
                ">Consumer"}};
  for (const StoredRun& run : runs) {
    const RunRecord& record = run.record;
    std::vector<ReportCell> row{fmt::format("{}", record.id), record.batch,
                                time_text(record.started), run_kind_name(record.kind)};
    if (run.outcome) {
      const RunOutcome& outcome = *run.outcome;
      row.insert(row.end(), {outcome.verdict, fmt::format("{}", outcome.panels),
                             fmt::format("{}", outcome.readings), share_text(outcome.producer_risk),
                             share_text(outcome.consumer_risk)});
    } else {
      row.insert(row.end(), {"not finished", fmt::format("of {}", record.panels), "-", "-", "-"});
    }
    table.rows.push_back(row);
  }
  return table;
}

ReportTable trend_table(const Trend& trend) {
  ReportTable table{.caption = trend_words(trend),
                    .heads = {">Run", "Started", "Kind", "Verdict", "Limits", ">Panels", ">Mean",
                              ">s", ">Cpk", ">Ppk"}};
  const bool is_of_several = trend.batch.empty();
  if (is_of_several) {
    table.heads.insert(table.heads.begin() + 1, "Batch");
  }
  for (const Trend::Point& point : trend.points) {
    const RunRecord& record = point.run->record;
    const ChannelTrend& found = *point.found;
    std::vector<ReportCell> row{fmt::format("{}", record.id),
                                time_text(record.started),
                                run_kind_name(record.kind),
                                point.run->outcome->verdict,
                                limits_words(limits_of(found), {}, trend.channel.unit),
                                fmt::format("{}", found.panels),
                                value_text(found.mean, found.standard_deviation),
                                found.panels > 1 ? spread_text(found.standard_deviation) : "-",
                                index_text(found.cpk),
                                index_text(found.ppk)};
    if (is_of_several) {
      row.insert(row.begin() + 1, record.batch);
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace gonio

#include <fmt/format.h>

#include "reports/control_figure.hpp"
#include "reports/escape.hpp"
#include "reports/page_verdict.hpp"
#include "reports/qa_history.hpp"
#include "reports/qa_trends.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

PageList trend_figures(Figures& figures, const Trend& trend) {
  PageList list;
  if (!trend.charts) {
    return list;
  }
  const std::string words = typeset(trend_words(trend));
  const ControlChart& individual = trend.charts->individual;
  list.push_back(control_figure(
      figures, individual, ControlPoints::run,
      fmt::format("I chart of the means of runs, {}{}: {}. Solid line: centre; dashed: control "
                  "limits; dotted: limits of the batch; shades: zones of one sigma",
                  words, in_unit(trend.channel), control_words(individual, "point")),
      trend.limits));
  const ControlChart& range = trend.charts->moving_range;
  list.push_back(control_figure(
      figures, range, ControlPoints::runs_moving_range,
      fmt::format("MR chart of the means of runs, {}{}: {}. Solid line: centre; dashed: control "
                  "limits",
                  words, in_unit(trend.channel), control_words(range, "point"))));
  return list;
}

PageData trend_data(Figures& figures, const Trend& trend) {
  PageData data("words", typeset(capitalised(trend_words(trend))));
  set_list(data, "charts", trend_figures(figures, trend));
  data.set("trend_table", table_data(trend_table(trend)));
  return data;
}

/// The latest run that is finished has the word.
PageData latest(const std::vector<StoredRun>& runs) {
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (run->outcome) {
      PageData data = verdict_data(run->outcome->verdict);
      data.set("run", fmt::format("{}", run->record.id));
      data.set("batch", run->record.batch);
      data.set("started", time_text(run->record.started));
      return data;
    }
  }
  return PageData(false);
}

}  // namespace

std::string history_page(const std::vector<StoredRun>& runs, const std::string& store,
                         const std::string& version) {
  Figures figures;
  PageList list;
  for (const Trend& trend : trends(runs)) {
    list.push_back(trend_data(figures, trend));
  }
  PageData data;
  data.set("sheet_foot", css_text(fmt::format("History of batches in {}", store)));
  data.set("store", store);
  data.set("counts", run_counts(runs));
  data.set("latest", latest(runs));
  data.set("version", version);
  data.set("run_table", runs.empty() ? PageData(false) : table_data(run_table(runs)));
  set_list(data, "trends", list);
  return render_page("qa_history", fmt::format("History of batches in {}", store), data);
}

}  // namespace gonio

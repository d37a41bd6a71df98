#include "reports/qa_history.hpp"
#include "reports/qa_trends.hpp"
#include "reports/qa_values_json.hpp"

namespace gonio {

namespace {

using gonio::json_of;  // beside those of this file
using nlohmann::ordered_json;

ordered_json json_of(const RunRecord& record, const ChannelTrend& found) {
  const bool is_known = found.channel < record.channels.size();
  return {{"channel", is_known ? ordered_json(record.channels[found.channel].id) : nullptr},
          {"panels", found.panels},
          {"readings", found.readings},
          {"mean", found.mean},
          {"sd", found.standard_deviation},
          {"low", json_of(found.low)},
          {"high", json_of(found.high)},
          {"cpk", json_of(found.cpk)},
          {"ppk", json_of(found.ppk)}};
}

ordered_json outcome_of(const StoredRun& run) {
  if (!run.outcome) {
    return nullptr;
  }
  const RunOutcome& outcome = *run.outcome;
  ordered_json channels = ordered_json::array();
  for (const ChannelTrend& found : outcome.channels) {
    channels.push_back(json_of(run.record, found));
  }
  return {{"verdict", verdict_name(outcome.verdict)},
          {"finished", outcome.finished},
          {"panels", outcome.panels},
          {"readings", outcome.readings},
          {"producer_risk", json_of(outcome.producer_risk)},
          {"consumer_risk", json_of(outcome.consumer_risk)},
          {"channels", channels}};
}

ordered_json json_of(const StoredRun& run) {
  ordered_json json = json_of(run.record);
  json["is_finished"] = run.outcome.has_value();
  json["outcome"] = outcome_of(run);
  return json;
}

ordered_json json_of(const Trend& trend) {
  ordered_json points = ordered_json::array();
  for (const Trend::Point& point : trend.points) {
    points.push_back({{"run", point.run->record.id}, {"mean", point.found->mean}});
  }
  return {
      {"batch", trend.batch.empty() ? ordered_json(nullptr) : ordered_json(trend.batch)},
      {"standard", trend.standard},
      {"channel", json_of(trend.channel)},
      {"limits", json_of(trend.limits)},
      {"points", points},
      {"individual", trend.charts ? json_of(trend.charts->individual) : ordered_json(nullptr)},
      {"moving_range", trend.charts ? json_of(trend.charts->moving_range) : ordered_json(nullptr)}};
}

}  // namespace

std::string history_json(const std::vector<StoredRun>& runs, const std::string& store) {
  ordered_json json{{"schema", "gonio/qa_history/1"}, {"store", store}};
  json["runs"] = ordered_json::array();
  for (const StoredRun& run : runs) {
    json["runs"].push_back(json_of(run));
  }
  json["trends"] = ordered_json::array();
  for (const Trend& trend : trends(runs)) {
    json["trends"].push_back(json_of(trend));
  }
  return json_text(json);
}

}  // namespace gonio

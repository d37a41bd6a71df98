#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emulator/core/unit_value.hpp"
#include "reports/conformance_report.hpp"
#include "reports/conformance_words.hpp"
#include "reports/json_values.hpp"

namespace gonio {

namespace {

using gonio::json_of;  // beside those of this file
using nlohmann::ordered_json;

ordered_json json_of(const LimitRow& limit) {
  ordered_json json{{"quantity", limit.quantity},
                    {"geometry", limit.geometry},
                    {"unit", limit.unit},
                    {"nominal", json_of(limit.nominal)},
                    {"tolerance", json_of(limit.tolerance)},
                    {"low", json_of(limit.low)},
                    {"high", json_of(limit.high)},
                    {"evidence", limit.evidence.level},
                    {"sources", limit.evidence.sources},
                    {"mark", json_of(limit.mark)}};
  return json;
}

ordered_json json_of(const SetupEffects& effects) {
  ordered_json json{{"geometry", effects.geometry},
                    {"quantity", quantity_name(effects)},
                    {"nominal_deg", stated_degrees(effects.nominal)},
                    {"as_built_deg", stated_degrees(effects.as_built)},
                    {"low_deg", stated_degrees(effects.low)},
                    {"high_deg", stated_degrees(effects.high)},
                    {"ladder", ordered_json::array()}};
  for (const LadderRow& row : effects.rows) {
    json["ladder"].push_back({{"sample", row.sample},
                              {"nominal_gu", row.nominal_gu},
                              {"as_built_gu", row.as_built_gu},
                              {"low_gu", row.low_gu},
                              {"high_gu", row.high_gu}});
  }
  return json;
}

ordered_json json_of(const Observation& observation) {
  return {{"quantity", observation.quantity},
          {"geometry", observation.geometry},
          {"subject", observation.subject},
          {"unit", observation.unit},
          {"value", json_of(observation.value)},
          {"expanded_uncertainty", observation.expanded_uncertainty},
          {"found", observation.found},
          {"expected", json_of(observation.expected)},
          {"expected_text", observation.expected_text},
          {"low", json_of(observation.low)},
          {"high", json_of(observation.high)},
          {"origin", observation.origin},
          {"verdict", verdict_name(observation.verdict)},
          {"note", observation.note}};
}

template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
  ordered_json list = ordered_json::array();
  for (const Item& item : items) {
    list.push_back(json_of(item));
  }
  return list;
}

ordered_json run_object(const ConformanceReport& report) {
  return {{"schema", "gonio/conformance/1"},
          {"record", "run"},
          {"standard", report.standard_id},
          {"title", report.title},
          {"edition", report.edition},
          {"transcription", report.transcription},
          {"device", report.device},
          {"device_detail", report.device_detail},
          {"decision_rule", report.decision_rule},
          {"version", report.version},
          {"date", report.date},
          {"seed", report.seed},
          {"should_counts", report.should_counts},
          {"verdict", verdict_name(report.verdict)},
          {"warnings", warnings(report)},
          {"clauses", report.clauses.size()},
          {"cases", report.cases.size()},
          {"sources", report.sources}};
}

ordered_json clause_object(const ConformanceReport& report, const ClauseResult& clause) {
  ordered_json cases = ordered_json::array();
  for (const std::size_t index : clause.cases) {
    cases.push_back(report.cases.at(index).address);
  }
  return {{"schema", "gonio/conformance/1"},
          {"record", "clause"},
          {"id", clause.id},
          {"level", clause.level},
          {"counts", is_counted(report, clause)},
          {"verdict", verdict_name(clause.verdict)},
          {"requirement", clause.requirement},
          {"coverage", clause.coverage},
          {"reason", clause.reason},
          {"evidence", clause.evidence.level},
          {"sources", clause.evidence.sources},
          {"mark", json_of(clause.mark)},
          {"limits", list_of(clause.limits)},
          {"cases", cases},
          {"effects", list_of(clause.effects)}};
}

ordered_json case_object(const CaseResult& result) {
  return {{"schema", "gonio/conformance/1"},
          {"record", "case"},
          {"address", result.address},
          {"clause", result.clause},
          {"id", result.id},
          {"role", role_name(result.role)},
          {"subject", result.subject},
          {"intent", result.intent},
          {"seed", result.seed},
          {"verdict", verdict_name(result.verdict)},
          {"expected", verdict_name(result.expected)},
          {"as_expected", result.is_as_expected()},
          {"message", result.message},
          {"mark", json_of(result.mark)},
          {"observations", list_of(result.observations)},
          {"duration_s", result.duration_s}};
}

/// Numbers that are not finite become null, bytes that are no UTF-8 become U+FFFD.
std::string line_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string conformance_json_lines(const ConformanceReport& report) {
  std::string lines = line_of(run_object(report));
  for (const ClauseResult& clause : report.clauses) {
    lines += line_of(clause_object(report, clause));
  }
  for (const CaseResult& result : report.cases) {
    lines += line_of(case_object(result));
  }
  return lines;
}

}  // namespace gonio

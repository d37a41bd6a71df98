#include "reports/qa_report.hpp"
#include "reports/qa_values_json.hpp"
#include "reports/qa_words.hpp"

namespace gonio {

namespace {

using gonio::json_of;  // beside those of this file
using nlohmann::ordered_json;

ordered_json json_of(const RiskSummary& risk) {
  return {{"conforming", json_of(risk.conforming)},
          {"accepted", json_of(risk.accepted)},
          {"producer", json_of(risk.producer)},
          {"consumer", json_of(risk.consumer)}};
}

ordered_json json_of(const Risks& risks) {
  ordered_json json{{"from_normal_model", risks.from_normal_model},
                    {"lots", risks.lots},
                    {"panels", risks.panels},
                    {"lot", json_of(risks.lot)},
                    {"panel", json_of(risks.panel)}};
  json["panel_normal"] = risks.panel_normal
                             ? ordered_json{{"producer", risks.panel_normal->producer},
                                            {"consumer", risks.panel_normal->consumer}}
                             : ordered_json(nullptr);
  return json;
}

ordered_json json_of(const LotSummary& lot) {
  return {{"number", lot.number},
          {"verdict", verdict_name(lot.verdict)},
          {"panels", lot.panels},
          {"nonconforming", lot.nonconforming},
          {"inconclusive", lot.inconclusive},
          {"not_uniform", lot.not_uniform},
          {"mean", lot.mean}};
}

ordered_json json_of(const QaResult& result, const OcCurve& curve) {
  ordered_json points = ordered_json::array();
  for (const OcPoint& point : curve.points) {
    points.push_back({{"offset", point.offset},
                      {"mean", point.mean},
                      {"beyond", point.beyond},
                      {"accepted", json_of(point.accepted)},
                      {"exact", json_of(point.exact)}});
  }
  return {{"channel", channel_at(result, curve.channel).id},
          {"parameter", curve.parameter},
          {"closed_form",
           curve.closed_form.empty() ? ordered_json(nullptr) : ordered_json(curve.closed_form)},
          {"lots_per_point", curve.lots},
          {"present_mean", curve.present_mean},
          {"points", points}};
}

ordered_json json_of(const ReadingsAnswer& answer) {
  ordered_json rows = ordered_json::array();
  for (const ReadingsAnswer::Row& row : answer.rows) {
    rows.push_back({{"readings", row.readings},
                    {"producer", json_of(row.producer)},
                    {"consumer", json_of(row.consumer)}});
  }
  return {{"risk", answer.risk},
          {"present", answer.present},
          {"needed", answer.needed ? ordered_json(*answer.needed) : ordered_json(nullptr)},
          {"words", answer_words(answer)},
          {"rows", rows}};
}

ordered_json json_of(const SpreadAnswer& answer) {
  ordered_json rows = ordered_json::array();
  for (const SpreadAnswer::Row& row : answer.rows) {
    rows.push_back(
        {{"spread", row.spread}, {"refused", json_of(row.refused)}, {"beyond", row.beyond}});
  }
  return {{"parameter", answer.parameter},
          {"risk", answer.risk},
          {"present", answer.present},
          {"allowed", json_of(answer.allowed)},
          {"unlimited", answer.unlimited},
          {"words", answer_words(answer)},
          {"rows", rows}};
}

template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
  ordered_json list = ordered_json::array();
  for (const Item& item : items) {
    list.push_back(json_of(item));
  }
  return list;
}

/// What scripts ask for first.
ordered_json head_of(const QaResult& result) {
  const bool has_channel = result.main_channel < result.channels.size();
  const ChannelSummary main = has_channel ? result.channels[result.main_channel] : ChannelSummary{};
  ordered_json cpk = nullptr;
  if (main.capability && main.capability->cpk) {
    cpk = main.capability->cpk->value;
  }
  const auto of_lot = [&](Estimate RiskSummary::*risk) {
    return result.risks ? ordered_json((result.risks->lot.*risk).value) : ordered_json(nullptr);
  };
  const bool has_mean = has_channel && main.panels > 0;
  return {{"schema", "gonio/qa/1"},
          {"verdict", verdict_name(result.verdict)},
          {"meaning", qa_meaning(result)},
          {"panels", result.panels},
          {"readings", result.readings},
          {"mean_gu", has_mean ? ordered_json(main.mean) : ordered_json(nullptr)},
          {"sd_gu", has_mean && main.panels > 1 ? ordered_json(main.standard_deviation)
                                                : ordered_json(nullptr)},
          {"cpk", cpk},
          {"producer_risk", of_lot(&RiskSummary::producer)},
          {"consumer_risk", of_lot(&RiskSummary::consumer)},
          {"store", result.store},
          {"run", result.run.id},
          {"main_channel", has_channel ? ordered_json(main.channel.id) : ordered_json(nullptr)},
          {"decision", result.decision},
          {"acceptance", result.acceptance}};
}

void add_counts(ordered_json& json, const QaResult& result) {
  json["panel_counts"] = {{"pass", result.panels_passed},
                          {"fail", result.panels_failed},
                          {"inconclusive", result.panels_inconclusive}};
  json["lot_counts"] = {{"accepted", result.lots_accepted},
                        {"refused", result.lots_refused},
                        {"inconclusive", result.lots_inconclusive}};
}

}  // namespace

std::string qa_json(const QaResult& result) {
  ordered_json json = head_of(result);
  add_counts(json, result);
  json["channels"] = json_list(result.channels);
  json["lots"] = list_of(result.lots);
  json["panel_mm"] = {{"length", result.panel_length_mm}, {"width", result.panel_width_mm}};
  json["gauge"] = ordered_json::array();
  for (const ChannelGauge& gauge : result.gauge) {
    json["gauge"].push_back(json_of(gauge, channel_at(result, gauge.channel)));
  }
  json["risks"] = result.risks ? json_of(*result.risks) : ordered_json(nullptr);
  json["oc_curves"] = ordered_json::array();
  for (const OcCurve& curve : result.oc_curves) {
    json["oc_curves"].push_back(json_of(result, curve));
  }
  json["readings_answer"] =
      result.readings_answer ? json_of(*result.readings_answer) : ordered_json(nullptr);
  json["spread_answers"] = list_of(result.spread_answers);
  json["surrogate_error"] = result.surrogate_error;
  json["remarks"] = result.remarks;
  json["provenance"] = json_of(result.run);
  json["provenance"]["batch_text"] = result.run.batch_text;
  return json_text(json);
}

}  // namespace gonio

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/certificate_budget.hpp"
#include "reports/certificate_report.hpp"
#include "reports/certificate_words.hpp"
#include "reports/json_values.hpp"

namespace gonio {

namespace {

using gonio::json_of;  // beside those of this file
using nlohmann::ordered_json;

double at_or_nothing(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::nan("");
}

ordered_json json_of(const CertificateLimit& limit) {
  const LimitRow& row = limit.limit;
  return {{"clause", limit.clause},
          {"geometry", row.geometry},
          {"quantity", row.quantity},
          {"unit", row.unit},
          {"nominal", json_of(row.nominal)},
          {"tolerance", json_of(row.tolerance)},
          {"low", json_of(row.low)},
          {"high", json_of(row.high)},
          {"as_built", json_of(limit.as_built)},
          {"expanded_uncertainty", limit.expanded_uncertainty},
          {"verdict", verdict_name(limit.verdict)},
          {"probability", json_of(limit.probability)},
          {"counts", limit.counts},
          {"evidence", row.evidence.level},
          {"sources", row.evidence.sources},
          {"mark", json_of(row.mark)},
          {"note", limit.note}};
}

const char* shape_name(Distribution::Shape shape) {
  constexpr std::array names{"normal", "student", "rectangular", "triangular", "arcsine"};
  return names.at(static_cast<std::size_t>(shape));
}

ordered_json json_of(const Distribution& distribution) {
  return {{"shape", shape_name(distribution.shape)},
          {"standard_uncertainty", distribution.standard_uncertainty},
          {"degrees_of_freedom", distribution.degrees_of_freedom},
          {"half_width", distribution.half_width()}};
}

ordered_json json_of(const CertificateInput& input) {
  return {{"id", input.id},
          {"component", input.component},
          {"geometry", input.geometry},
          {"unit", input.unit},
          {"estimate", input.estimate},
          {"distribution", json_of(input.distribution)}};
}

ordered_json budget_of(const Certificate& certificate, const GeometryCertificate& geometry,
                       const CertifiedReading& reading) {
  ordered_json list = ordered_json::array();
  for (const BudgetLine& line : budget_lines(certificate, geometry, reading)) {
    const Distribution& distribution = line.input->distribution;
    list.push_back({{"component", line.input->component},
                    {"input", line.input->id},
                    {"unit", line.input->unit},
                    {"u", distribution.standard_uncertainty},
                    {"distribution", shape_name(distribution.shape)},
                    {"degrees_of_freedom", distribution.degrees_of_freedom},
                    {"sensitivity", line.contribution->sensitivity},
                    {"sensitivity_error", line.sensitivity_error},
                    {"contribution_gu", line.contribution->contribution},
                    {"share", line.contribution->share}});
  }
  return list;
}

ordered_json json_of(const GeometryCertificate& geometry, const WorstCase& corner) {
  ordered_json setup = ordered_json::object();
  for (std::size_t i = 0; i < geometry.quantities.size(); ++i) {
    setup[setup_quantity_names.at(static_cast<std::size_t>(geometry.quantities[i]))] =
        at_or_nothing(corner.setup, i);
  }
  return {{"change_gu", corner.change_gu}, {"setup_deg", setup}};
}

ordered_json json_of(const MonteCarloOutput& output) {
  return {{"mean_gu", output.mean},
          {"u_gu", output.standard_uncertainty},
          {"U_gu", output.expanded_uncertainty()},
          {"low_gu", output.low},
          {"high_gu", output.high},
          {"instability", output.instability}};
}

ordered_json sample_object(const Certificate& certificate, const GeometryCertificate& geometry,
                           std::size_t i) {
  const CertifiedReading& reading = geometry.readings[i];
  const Propagated& propagated = reading.propagated;
  return {{"id", sample_id(certificate, i)},
          {"title", sample_title(certificate, i)},
          {"geometry", geometry.id},
          {"gloss_gu", reading.gloss_gu},
          {"u_gu", propagated.standard_uncertainty},
          {"U_gu", propagated.expanded_uncertainty},
          {"k", propagated.coverage_factor},
          {"degrees_of_freedom", propagated.degrees_of_freedom},
          {"nominal_gu", reading.nominal_gu},
          {"deviation_gu", reading.deviation_gu()},
          {"before_adjustment_gu", reading.before_adjustment_gu},
          {"monte_carlo", json_of(reading.monte_carlo)},
          {"methods_agree", reading.methods_agree},
          {"surrogate_error_gu", is_read_directly(geometry, i)
                                     ? std::nan("")
                                     : at_or_nothing(geometry.surrogate_error_gu, i)},
          {"worst_case",
           {{"lowest", json_of(geometry, reading.lowest)},
            {"highest", json_of(geometry, reading.highest)}}},
          {"budget", budget_of(certificate, geometry, reading)}};
}

ordered_json json_of(const DeviationEffect& effect) {
  return {{"component", effect.component},      {"unit", effect.unit},
          {"nominal", json_of(effect.nominal)}, {"as_built", json_of(effect.as_built)},
          {"low", json_of(effect.low)},         {"high", json_of(effect.high)},
          {"as_built_gu", effect.as_built_gu},  {"low_gu", effect.low_gu},
          {"high_gu", effect.high_gu}};
}

ordered_json json_of(const GeometryCertificate& geometry);
ordered_json json_of(const EstimatedParameter& parameter);
ordered_json json_of(const TileReading& reading);
ordered_json json_of(const SetupEstimate& estimate);

template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
  ordered_json list = ordered_json::array();
  for (const Item& item : items) {
    list.push_back(json_of(item));
  }
  return list;
}

ordered_json json_of(const GeometryCertificate& geometry) {
  ordered_json quantities = ordered_json::array();
  for (const SetupQuantity quantity : geometry.quantities) {
    quantities.push_back(setup_quantity_names.at(static_cast<std::size_t>(quantity)));
  }
  return {{"id", geometry.id},
          {"theta_i_deg", geometry.theta_i_deg},
          {"quantities", quantities},
          {"effects", list_of(geometry.effects)}};
}

ordered_json json_of(const EstimatedParameter& parameter) {
  return {{"name", parameter.name},
          {"unit", parameter.unit},
          {"assumed", parameter.assumed},
          {"prior_u", parameter.prior_uncertainty},
          {"estimate", parameter.estimate},
          {"u", parameter.standard_uncertainty},
          {"is_determined", parameter.is_determined}};
}

ordered_json json_of(const TileReading& reading) {
  return {{"sample", reading.sample},
          {"geometry", reading.geometry},
          {"gloss_gu", reading.gloss_gu},
          {"U_gu", json_of(reading.expanded_uncertainty_gu)},
          {"mark", json_of(reading.mark)}};
}

ordered_json json_of(const SetupEstimate& estimate) {
  ordered_json confusions = ordered_json::array();
  for (const Confusion& confusion : estimate.confusions) {
    confusions.push_back({{"direction", confusion.direction},
                          {"remaining", confusion.remaining},
                          {"words", confusion_words(estimate, confusion)}});
  }
  return {{"geometry", estimate.geometry},
          {"has_converged", estimate.has_converged},
          {"chi_squared", estimate.chi_squared},
          {"degrees_of_freedom", estimate.degrees_of_freedom},
          {"p_value", estimate.p_value},
          {"parameters", list_of(estimate.parameters)},
          {"correlation", estimate.correlation},
          {"confusions", confusions},
          {"readings", list_of(estimate.readings)},
          {"residual_gu", estimate.residual_gu}};
}

ordered_json json_of(const Laboratory& laboratory) {
  return {{"name", laboratory.name},
          {"address", laboratory.address},
          {"accreditation", laboratory.accreditation},
          {"certificate_number", laboratory.certificate_number},
          {"customer", laboratory.customer},
          {"received", laboratory.received},
          {"calibrated", laboratory.calibrated},
          {"issued", laboratory.issued},
          {"temperature", laboratory.temperature},
          {"humidity", laboratory.humidity},
          {"reference_standards", laboratory.reference_standards},
          {"traceability", laboratory.traceability},
          {"procedure", laboratory.procedure},
          {"signatory", laboratory.signatory},
          {"notes", laboratory.notes}};
}

ordered_json json_of(const Instrument& instrument) {
  return {{"id", instrument.id},
          {"title", instrument.title},
          {"manufacturer", instrument.identity.manufacturer},
          {"model", instrument.identity.model},
          {"serial_number", instrument.identity.serial_number}};
}

ordered_json json_of(const Standard& standard) {
  return {{"id", standard.id},
          {"title", standard.title},
          {"edition", standard.edition},
          {"transcription", standard.transcription},
          {"unit", standard.scale.unit}};
}

ordered_json head_of(const CertificateReport& report) {
  const Certificate& certificate = report.certificate;
  return {{"schema", "gonio/certificate/1"},
          {"verdict", verdict_name(certificate.verdict)},
          {"meaning", certificate_meaning(certificate)},
          {"warnings", certificate_warnings(certificate)},
          {"statement", simulation_words()},
          {"standard", json_of(certificate.standard)},
          {"instrument", json_of(certificate.instrument)},
          {"laboratory", json_of(report.laboratory)},
          {"version", report.version},
          {"date", report.date},
          {"decision_rule",
           {{"name", certificate.decision_rule == DecisionRule::simple ? "simple" : "guarded"},
            {"guard_band_factor", certificate.guard_band_factor},
            {"words", decision_words(certificate)}}},
          {"coverage", certificate.coverage},
          {"monte_carlo",
           {{"seed", certificate.seed},
            {"trials", certificate.trials},
            {"direct_trials", certificate.direct_trials},
            {"is_stable", certificate.is_stable}}}};
}

}  // namespace

std::string certificate_json(const CertificateReport& report) {
  const Certificate& certificate = report.certificate;
  ordered_json json = head_of(report);
  json["limits"] = list_of(certificate.limits);
  json["inputs"] = list_of(certificate.inputs);
  json["samples"] = ordered_json::array();
  for (const GeometryCertificate& geometry : certificate.geometries) {
    for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
      json["samples"].push_back(sample_object(certificate, geometry, i));
    }
  }
  json["geometries"] = list_of(certificate.geometries);
  json["estimates"] = list_of(certificate.estimates);
  json["sources"] = report.sources;
  return json_text(json);
}

}  // namespace gonio

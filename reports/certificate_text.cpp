#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/certificate_budget.hpp"
#include "reports/certificate_report.hpp"
#include "reports/certificate_words.hpp"
#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"
#include "reports/limit_words.hpp"
#include "reports/measurement_words.hpp"
#include "reports/text_table.hpp"

namespace gonio {

namespace {

constexpr std::size_t indent = 2;

std::string heading(const std::string& text, bool styled) {
  const std::string line = one_line(text);
  return styled ? fmt::format("\n\033[1m{}\033[0m\n", line) : fmt::format("\n{}\n", line);
}

std::string head(const CertificateReport& report, bool styled) {
  const Certificate& certificate = report.certificate;
  const std::string verdict = verdict_words(certificate.verdict);
  std::string text =
      fmt::format("{}: {}\n", styled ? fmt::format("\033[1m{}\033[0m", verdict) : verdict,
                  one_line(certificate_meaning(certificate)));
  for (const std::string& warning : certificate_warnings(certificate)) {
    text += one_line(warning) + "\n";
  }
  const Identity& identity = certificate.instrument.identity;
  text += fmt::format(
      "\n{} - {}\n{}: {} {}, serial number {}\ndecision rule: {}\nMonte Carlo: {} trials, seed {}\n"
      "{}\n",
      one_line(certificate.standard.id), one_line(certificate.standard.title),
      one_line(certificate.instrument.title), one_line(identity.manufacturer),
      one_line(identity.model), one_line(identity.serial_number),
      one_line(decision_words(certificate)), certificate.trials, certificate.seed,
      simulation_words());
  return text;
}

std::string limits(const Certificate& certificate, bool styled) {
  TextTable table(
      {"clause", "quantity", "limit", ">as built", "verdict", ">P(conforms)", "evidence", "note"});
  for (const CertificateLimit& limit : certificate.limits) {
    table.add({limit.clause, limit_name(limit.limit), limit_text(limit.limit),
               found_text(observation_of(limit)), verdict_of(limit),
               probability_text(limit.probability), evidence_text(limit.limit.evidence),
               limit.note});
  }
  return heading("Limits", styled) + table.text(indent);
}

std::string ladder(const Certificate& certificate, const GeometryCertificate& geometry) {
  TextTable table({">no.", "sample", ">nominal", ">before adj.", ">as built", ">deviation", ">u",
                   ">U", ">k", ">U by MC", ">worst low", ">worst high"});
  for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
    const CertifiedReading& reading = geometry.readings[i];
    const Propagated& u = reading.propagated;
    const auto value = [&](double gu) { return measured_text(gu, u.expanded_uncertainty); };
    table.add({fmt::format("{}", i + 1), sample_id(certificate, i), value(reading.nominal_gu),
               value(reading.before_adjustment_gu), value(reading.gloss_gu),
               signed_text(reading.deviation_gu(), decimals_of(u.expanded_uncertainty)),
               uncertainty_text(u.standard_uncertainty), uncertainty_text(u.expanded_uncertainty),
               fixed_text(u.coverage_factor, 2),
               uncertainty_text(reading.monte_carlo.expanded_uncertainty()) +
                   (reading.methods_agree ? "" : " !"),
               signed_text(reading.lowest.change_gu, 3),
               signed_text(reading.highest.change_gu, 3)});
  }
  return table.text(indent);
}

/// The worst of all within the limits, and where it is.
std::string worst_line(const Certificate& certificate, const GeometryCertificate& geometry) {
  const WorstCase* worst = nullptr;
  std::size_t where = 0;
  for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
    for (const WorstCase* one : {&geometry.readings[i].lowest, &geometry.readings[i].highest}) {
      if (worst == nullptr || std::abs(one->change_gu) > std::abs(worst->change_gu)) {
        worst = one;
        where = i;
      }
    }
  }
  return worst == nullptr ? ""
                          : fmt::format("  worst within the limits: {} GU, {}, at {}\n",
                                        signed_text(worst->change_gu, 3),
                                        one_line(sample_id(certificate, where)),
                                        one_line(corner_text(geometry, *worst)));
}

std::string effects(const GeometryCertificate& geometry, bool styled) {
  std::vector<std::string> heads{"deviation alone", ">nominal", ">as built"};
  for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
    heads.push_back(fmt::format(">{}", i + 1));
  }
  TextTable table(heads);
  for (const DeviationEffect& effect : geometry.effects) {
    const auto stated = [&](const std::optional<double>& value) {
      return value ? number_text(*value, effect.unit) : "";
    };
    std::vector<std::string> cells{effect.component, stated(effect.nominal),
                                   stated(effect.as_built)};
    for (const double change : effect.as_built_gu) {
      cells.push_back(signed_text(change, 3));
    }
    table.add(cells);
  }
  return heading(fmt::format("Geometry {}: change of the readings as built / GU, by the number of "
                             "the sample",
                             geometry.id),
                 styled) +
         table.text(indent);
}

std::string budget(const Certificate& certificate, const GeometryCertificate& geometry,
                   const ShownBudget& shown, bool styled) {
  const CertifiedReading& reading = geometry.readings[shown.sample];
  TextTable table({"component", ">u", "unit", "distribution", ">sensitivity / GU per unit",
                   ">contribution / GU", ">share"});
  for (const BudgetLine& line : main_budget_lines(certificate, geometry, reading)) {
    const Contribution& part = *line.contribution;
    table.add({line.input->component, input_text(line.input->distribution.standard_uncertainty),
               line.input->unit, distribution_text(line.input->distribution),
               fmt::format("{:.4g}", part.sensitivity), uncertainty_text(part.contribution),
               fmt::format("{:.1f} %", 100.0 * part.share)});
  }
  const std::string why = shown.why.empty() ? "" : fmt::format(" ({})", shown.why);
  return heading(fmt::format("Geometry {}: budget of {}{}: u = {} GU, {} degrees of freedom",
                             geometry.id, sample_id(certificate, shown.sample), why,
                             uncertainty_text(reading.propagated.standard_uncertainty),
                             freedom_text(reading.propagated.degrees_of_freedom)),
                 styled) +
         table.text(indent);
}

std::string estimate_text(const SetupEstimate& estimate, bool styled) {
  TextTable table(
      {"parameter", "unit", ">assumed", ">+- U", ">estimate", ">+- U", "told by the readings"});
  for (const EstimatedParameter& parameter : estimate.parameters) {
    const double prior = 2.0 * parameter.prior_uncertainty;
    const double left = 2.0 * parameter.standard_uncertainty;
    table.add({parameter.name, parameter.unit, number_text(parameter.assumed),
               uncertainty_text(prior), measured_text(parameter.estimate, left),
               uncertainty_text(left), parameter.is_determined ? "yes" : "no"});
  }
  std::string text =
      heading(fmt::format("Geometry {}: the set-up behind the readings", estimate.geometry),
              styled) +
      table.text(indent) + fmt::format("  {}\n", one_line(fit_words(estimate)));
  for (const Confusion& confusion : estimate.confusions) {
    text += fmt::format("  {}\n", one_line(confusion_words(estimate, confusion)));
  }
  return text;
}

std::string geometry_text(const CertificateReport& report, const GeometryCertificate& geometry,
                          bool styled) {
  const Certificate& certificate = report.certificate;
  std::string text = heading(fmt::format("Geometry {}: readings / GU; U for {:g} %", geometry.id,
                                         100.0 * certificate.coverage),
                             styled) +
                     ladder(certificate, geometry) + worst_line(certificate, geometry) +
                     fmt::format("  {}\n", one_line(surrogate_words(certificate, geometry))) +
                     effects(geometry, styled);
  for (const ShownBudget& shown : shown_budgets(report, geometry)) {
    text += budget(certificate, geometry, shown, styled);
  }
  return text;
}

}  // namespace

std::string certificate_text(const CertificateReport& report, bool styled) {
  std::string text = head(report, styled) + limits(report.certificate, styled);
  for (const GeometryCertificate& geometry : report.certificate.geometries) {
    text += geometry_text(report, geometry, styled);
  }
  for (const SetupEstimate& estimate : report.certificate.estimates) {
    text += estimate_text(estimate, styled);
  }
  return text;
}

}  // namespace gonio

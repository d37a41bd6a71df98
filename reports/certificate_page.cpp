#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/certificate_charts.hpp"
#include "reports/certificate_report.hpp"
#include "reports/certificate_results.hpp"
#include "reports/certificate_words.hpp"
#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"
#include "reports/limit_words.hpp"
#include "reports/page.hpp"
#include "reports/page_verdict.hpp"

namespace gonio {

namespace {

std::string or_not_stated(const std::string& text) { return text.empty() ? "not stated" : text; }

void add_fact(PageList& list, const char* name, const std::string& value) {
  PageData data("name", name);
  data.set("value", typeset(or_not_stated(value)));
  list.push_back(data);
}

PageList head_facts(const CertificateReport& report) {
  const Laboratory& laboratory = report.laboratory;
  const Instrument& instrument = report.certificate.instrument;
  PageList list;
  add_fact(list, "Certificate number", laboratory.certificate_number);
  add_fact(list, "Accreditation", laboratory.accreditation);
  add_fact(list, "Customer", laboratory.customer);
  add_fact(list, "Item", instrument.title);
  add_fact(list, "Maker and model",
           fmt::format("{}, {}", instrument.identity.manufacturer, instrument.identity.model));
  add_fact(list, "Serial number", instrument.identity.serial_number);
  add_fact(list, "Received", laboratory.received);
  add_fact(list, "Calibrated", laboratory.calibrated);
  add_fact(list, "Issued", laboratory.issued.empty() ? report.date : laboratory.issued);
  return list;
}

std::string method_words(const CertificateReport& report) {
  const Standard& standard = report.certificate.standard;
  return fmt::format("{}, {} (edition {}; transcription: {})", standard.id, standard.title,
                     or_not_stated(standard.edition), or_not_stated(standard.transcription));
}

PageList method_facts(const CertificateReport& report) {
  const Certificate& certificate = report.certificate;
  const Laboratory& laboratory = report.laboratory;
  PageList list;
  add_fact(list, "Method", method_words(report));
  add_fact(list, "What was done",
           fmt::format("gonio {} computed what the set-up as stated reads of a ladder of samples, "
                       "with the reference read through the same set-up; uncertainties by the law "
                       "of propagation and by Monte Carlo ({} trials, seed {}{})",
                       or_not_stated(report.version), certificate.trials, certificate.seed,
                       certificate.is_stable ? ", stable to two digits" : ""));
  add_fact(list, "Procedure of the laboratory", laboratory.procedure);
  add_fact(list, "Temperature", laboratory.temperature);
  add_fact(list, "Humidity", laboratory.humidity);
  add_fact(list, "Reference standards",
           fmt::format("{}", fmt::join(laboratory.reference_standards, "; ")));
  add_fact(list, "Traceability", laboratory.traceability);
  add_fact(list, "Notes", laboratory.notes);
  return list;
}

/// e.g. "angle of incidence at 60".
std::string quantity_words(LimitRow limit) {
  limit.quantity = component_words(limit.quantity);
  return limit_name(limit);
}

PageList limit_list(const Certificate& certificate) {
  PageList list;
  for (const CertificateLimit& limit : certificate.limits) {
    PageList sources;
    for (const std::string& key : limit.limit.evidence.sources) {
      PageData source("key", key);
      source.set("anchor", anchor("source", key));
      sources.push_back(source);
    }
    PageData data("name", quantity_words(limit.limit));
    data.set("limit", typeset(limit_text(limit.limit)));
    data.set("found", typeset(found_text(observation_of(limit))));
    data.set("verdict", verdict_data(limit.verdict));
    data.set("not_counted", PageData(!limit.counts));
    data.set("probability", probability_text(limit.probability));
    data.set("clause", limit.clause);
    data.set("level", limit.limit.evidence.level);
    data.set("sources", PageData(sources));
    data.set("place", place_text(limit.limit.mark));
    set_text(data, "note", limit.note);
    list.push_back(data);
  }
  return list;
}

PageList parameter_list(const SetupEstimate& estimate) {
  const auto with_uncertainty = [](double value, double U, const std::string& unit) {
    return typeset(fmt::format("{} +- {} {}", measured_text(value, U), uncertainty_text(U), unit));
  };
  PageList list;
  for (const EstimatedParameter& parameter : estimate.parameters) {
    PageData data("name", component_words(parameter.name));
    data.set("assumed", with_uncertainty(parameter.assumed, 2.0 * parameter.prior_uncertainty,
                                         parameter.unit));
    data.set("estimate", with_uncertainty(parameter.estimate, 2.0 * parameter.standard_uncertainty,
                                          parameter.unit));
    data.set("determined", parameter.is_determined ? "yes" : "no");
    list.push_back(data);
  }
  return list;
}

PageList estimate_list(const Certificate& certificate) {
  PageList list;
  for (const SetupEstimate& estimate : certificate.estimates) {
    std::vector<std::string> confusions;
    for (const Confusion& confusion : estimate.confusions) {
      confusions.push_back(confusion_words(estimate, confusion));
    }
    PageData data("geometry", estimate.geometry);
    data.set("parameters", PageData(parameter_list(estimate)));
    data.set("fit", fit_words(estimate));
    set_list(data, "confusions", text_list(confusions));
    list.push_back(data);
  }
  return list;
}

/// Those that a limit names, described or not.
PageList source_list(const CertificateReport& report) {
  std::set<std::string> keys;
  for (const CertificateLimit& limit : report.certificate.limits) {
    keys.insert(limit.limit.evidence.sources.begin(), limit.limit.evidence.sources.end());
  }
  PageList list;
  for (const std::string& key : keys) {
    const auto found = report.sources.find(key);
    PageData data("key", key);
    data.set("anchor", anchor("source", key));
    data.set("what", found == report.sources.end() ? "not described" : found->second);
    list.push_back(data);
  }
  return list;
}

void add_geometries(PageData& data, const CertificateReport& report) {
  Figures figures;
  PageList apertures;
  PageList geometries;
  for (const GeometryCertificate& geometry : report.certificate.geometries) {
    if (has_openings(geometry)) {
      apertures.push_back(apertures_figure(figures, geometry));
    }
  }
  for (const GeometryCertificate& geometry : report.certificate.geometries) {
    geometries.push_back(geometry_data(figures, report, geometry));
  }
  set_list(data, "apertures", apertures);
  data.set("geometries", PageData(geometries));
}

}  // namespace

std::string certificate_page(const CertificateReport& report) {
  const Certificate& certificate = report.certificate;
  const Laboratory& laboratory = report.laboratory;
  const std::string number =
      laboratory.certificate_number.empty() ? "without a number" : laboratory.certificate_number;
  PageData data;
  data.set("sheet_foot",
           css_text(fmt::format("Calibration certificate {}, of a simulated set-up", number)));
  data.set("laboratory_name", laboratory.name.empty() ? "Laboratory not stated" : laboratory.name);
  set_text(data, "laboratory_address", laboratory.address);
  data.set("simulation", simulation_words());
  data.set("head_facts", PageData(head_facts(report)));
  data.set("method_facts", PageData(method_facts(report)));
  data.set("verdict", verdict_data(certificate.verdict));
  data.set("standard_id", certificate.standard.id);
  data.set("unit", certificate.standard.scale.unit);
  data.set("coverage", fmt::format("{:g} %", 100.0 * certificate.coverage));
  data.set("meaning", certificate_meaning(certificate));
  data.set("decision", decision_words(certificate));
  set_list(data, "warnings", text_list(certificate_warnings(certificate)));
  data.set("limits", PageData(limit_list(certificate)));
  add_geometries(data, report);
  set_list(data, "estimates", estimate_list(certificate));
  set_list(data, "source_list", source_list(report));
  data.set("issued", laboratory.issued.empty() ? or_not_stated(report.date) : laboratory.issued);
  data.set("signatory", or_not_stated(laboratory.signatory));
  data.set("number", number);
  data.set("version", or_not_stated(report.version));
  return render_page(
      "certificate",
      fmt::format("Calibration certificate {}: {}", number, certificate.instrument.title), data);
}

}  // namespace gonio

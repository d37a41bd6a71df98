#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "reports/conformance_report.hpp"
#include "reports/conformance_words.hpp"
#include "reports/measurement_words.hpp"
#include "reports/page.hpp"
#include "reports/page_charts.hpp"
#include "reports/page_verdict.hpp"

namespace gonio {

namespace {

PageData link(const std::string& text_key, const std::string& text, const std::string& to) {
  PageData data(text_key, text);
  data.set("anchor", to);
  return data;
}

PageList source_links(const std::vector<std::string>& keys) {
  PageList list;
  for (const std::string& key : keys) {
    list.push_back(link("key", key, anchor("source", key)));
  }
  return list;
}

PageData evidence_data(const Evidence& evidence) {
  PageData data("level", evidence.level);
  data.set("sources", PageData(source_links(evidence.sources)));
  return data;
}

std::string limit_anchor(const ClauseResult& clause, const LimitRow& limit) {
  return anchor("limit", fmt::format("{} {}", clause.id, limit_name(limit)));
}

/// What a clause and its limits rest on, each source once.
std::vector<std::string> sources_of(const ClauseResult& clause) {
  std::vector<std::string> keys = clause.evidence.sources;
  for (const LimitRow& limit : clause.limits) {
    for (const std::string& key : limit.evidence.sources) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        keys.push_back(key);
      }
    }
  }
  return keys;
}

PageList limit_list(const ClauseResult& clause) {
  PageList list;
  for (const LimitRow& limit : clause.limits) {
    PageData data = link("name", limit_name(limit), limit_anchor(clause, limit));
    data.set("text", typeset(limit_text(limit)));
    data.set("evidence", evidence_data(limit.evidence));
    data.set("place", place_text(limit.mark));
    list.push_back(data);
  }
  return list;
}

PageList ladder_rows(const SetupEffects& effects) {
  // Thousandths of a gloss unit are below what any glossmeter repeats.
  const auto gloss = [](double value) { return fixed_text(value, 3); };
  PageList list;
  for (const LadderRow& row : effects.rows) {
    PageData data("number", fmt::format("{}", list.size() + 1));
    data.set("title", row.title);
    data.set("nominal_gu", gloss(row.nominal_gu));
    data.set("low_gu", gloss(row.low_gu));
    data.set("high_gu", gloss(row.high_gu));
    data.set("as_built_gu", gloss(row.as_built_gu));
    list.push_back(data);
  }
  return list;
}

PageList effects_list(const ClauseResult& clause) {
  const auto angle = [](Angle value) { return number_text(value.degrees(), "deg"); };
  PageList list;
  for (const SetupEffects& effects : clause.effects) {
    PageData data("name",
                  fmt::format("{} at geometry {}", quantity_name(effects), effects.geometry));
    data.set("nominal", angle(effects.nominal));
    data.set("low", angle(effects.low));
    data.set("high", angle(effects.high));
    data.set("as_built", angle(effects.as_built));
    data.set("rows", PageData(ladder_rows(effects)));
    list.push_back(data);
  }
  return list;
}

PageData clause_data(const ConformanceReport& report, const ClauseResult& clause) {
  PageData data = link("id", clause.id, anchor("clause", clause.id));
  PageList cases;
  for (const std::size_t index : clause.cases) {
    const CaseResult& result = report.cases.at(index);
    cases.push_back(link("id", result.id, anchor("case", result.address)));
  }
  data.set("verdict_name", verdict_name(clause.verdict));
  data.set("verdict", verdict_data(clause.verdict));
  data.set("level", clause.level);
  data.set("level_text", level_text(report, clause));
  data.set("requirement", clause.requirement);
  set_text(data, "limits_text", typeset(limits_text(clause)));
  data.set("coverage", coverage_text(clause));
  data.set("evidence", evidence_data(clause.evidence));
  data.set("place", place_text(clause.mark));
  data.set("case_links", PageData(cases));
  set_list(data, "limits", limit_list(clause));
  data.set("effects", PageData(effects_list(clause)));
  return data;
}

PageList observation_list(const CaseResult& result) {
  PageList list;
  for (const Observation& observation : result.observations) {
    PageData data("name", observation_name(observation));
    data.set("found", typeset(found_text(observation)));
    data.set("limit", typeset(limit_text(observation)));
    data.set("words", verdict_words(observation.verdict));
    set_text(data, "origin", observation.origin);
    set_text(data, "note", observation.note);
    list.push_back(data);
  }
  return list;
}

PageData case_data(const ClauseResult& clause, const CaseResult& result) {
  PageData data = link("id", result.id, anchor("case", result.address));
  data.set("verdict_name", verdict_name(result.verdict));
  data.set("verdict", verdict_data(result.verdict));
  data.set("level", clause.level);
  data.set("intent", result.intent);
  data.set("tried", result.subject.empty()
                        ? role_name(result.role)
                        : fmt::format("{}: {}", role_name(result.role), result.subject));
  data.set("is_control", PageData(result.role != CaseRole::device && result.is_as_expected()));
  const std::string found = found_text(result);
  set_text(data, "remark",
           found == verdict_words(result.verdict) ? "" : found.substr(found.find(", ") + 2));
  set_text(data, "message", result.message);
  set_list(data, "observations", observation_list(result));
  data.set("clause", link("id", clause.id, anchor("clause", clause.id)));
  set_list(data, "limits", limit_list(clause));
  data.set("evidence", clause.evidence.level);
  data.set("sources", PageData(source_links(sources_of(clause))));
  data.set("place", place_text(result.mark));
  return data;
}

PageList fact_list(const ConformanceReport& report) {
  PageList list;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) {
      PageData data("name", name);
      data.set("value", value);
      list.push_back(data);
    }
  };
  add("Device", report.device);
  add("Found at", report.device_detail);
  add("Edition", report.edition);
  add("Transcription", fmt::format("{}. {}", report.transcription, report.notes));
  add("Decision rule", report.decision_rule);
  add("Date", report.date);
  add("gonio", report.version);
  add("Seed", fmt::format("{}", report.seed));
  return list;
}

PageList verdict_options() {
  PageList list;
  for (const ConformanceVerdict verdict : all_verdicts) {
    list.push_back(verdict_data(verdict));
  }
  return list;
}

/// The charts, in the order of the page.
void add_charts(PageData& data, const ConformanceReport& report) {
  Figures figures;
  PageList footprints;
  for (const Footprint& footprint : report.footprints) {
    footprints.push_back(footprint_figure(figures, footprint));
  }
  PageList weightings;
  std::vector<SpectralCurve> curves;
  for (const WeightingCurve& curve : report.weightings) {
    curves.push_back({curve.title, curve.wavelength_nm, curve.weight});
  }
  if (!curves.empty()) {
    weightings.push_back(
        curves_figure(figures, CurveKind::weight,
                      "Source times responsivity, of sum 1: the device and the standard", curves));
  }
  std::map<std::string, std::vector<const SetupEffects*>> by_geometry;
  for (const ClauseResult& clause : report.clauses) {
    for (const SetupEffects& effects : clause.effects) {
      by_geometry[effects.geometry].push_back(&effects);
    }
  }
  PageList ladders;
  for (const auto& [geometry, effects] : by_geometry) {
    ladders.push_back(ladder_figure(figures, effects));
  }
  data.set("has_charts", PageData(!footprints.empty() || !weightings.empty() || !ladders.empty()));
  set_list(data, "footprints", footprints);
  set_list(data, "weightings", weightings);
  set_list(data, "ladders", ladders);
}

void add_clauses_and_cases(PageData& data, const ConformanceReport& report) {
  PageList clauses;
  PageList cases;
  std::set<std::string> levels;
  for (const ClauseResult& clause : report.clauses) {
    levels.insert(clause.level);
    clauses.push_back(clause_data(report, clause));
    for (const std::size_t index : clause.cases) {
      cases.push_back(case_data(clause, report.cases.at(index)));
    }
  }
  data.set("levels", PageData(text_list({levels.begin(), levels.end()})));
  data.set("verdicts", PageData(verdict_options()));
  set_list(data, "clauses", clauses);
  set_list(data, "cases", cases);
}

PageList source_list(const ConformanceReport& report) {
  std::map<std::string, std::string> sources = report.sources;
  for (const ClauseResult& clause : report.clauses) {
    for (const std::string& key : sources_of(clause)) {
      sources.emplace(key, "not described");
    }
  }
  PageList list;
  for (const auto& [key, what] : sources) {
    PageData data = link("key", key, anchor("source", key));
    data.set("what", what);
    list.push_back(data);
  }
  return list;
}

}  // namespace

std::string conformance_page(const ConformanceReport& report) {
  PageData data;
  data.set("standard_id", report.standard_id);
  data.set("standard_title", report.title);
  data.set("verdict", verdict_data(report.verdict));
  data.set("meaning", verdict_meaning(report));
  data.set("clause_counts", clause_counts(report));
  data.set("case_counts", case_counts(report));
  data.set("warnings", PageData(text_list(warnings(report))));
  data.set("facts", PageData(fact_list(report)));
  data.set("source_list", PageData(source_list(report)));
  add_clauses_and_cases(data, report);
  add_charts(data, report);
  return render_page(
      "conformance",
      fmt::format("{}: {}, {}", verdict_words(report.verdict), report.standard_id, report.device),
      data);
}

}  // namespace gonio

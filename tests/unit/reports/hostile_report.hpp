#pragma once

#include <filesystem>
#include <string>

#include "tests/unit/reports/example_report.hpp"

// The example with texts that want to be more than text, wherever a text can stand.

namespace gonio::test {

/// @param trace  a file that is there if anybody runs the text.
inline std::string hostile_text(const std::filesystem::path& trace) {
  const std::string run = "touch " + trace.string();
  return "`" + run + "` $(" + run + ") \"; system('" + run +
         "') <script>document.title = 'run'</script> ' \" ]]> | a | {{title}} {{{svg}}} & &amp; "
         "\\ *b* _c_ [d](e)\nline 2\r\n# head\t\x1B[31m \xC2\x9B \xFF \xEF\xBF\xBE Stra\u00DFe "
         "\u5149 END_OF_NUMBERS";
}

inline void spoil(SourceMark& mark, const std::string& text) { mark.file = text; }
inline void spoil(Evidence& evidence, const std::string& text) { evidence.sources = {text}; }

inline void spoil(CaseResult& result, const std::string& text) {
  result.id = result.clause = result.address = result.intent = text;
  result.subject = result.message = text;
  spoil(result.mark, text);
  for (Observation& observation : result.observations) {
    observation.quantity = observation.geometry = observation.subject = observation.unit = text;
    observation.found = observation.expected_text = observation.origin = observation.note = text;
  }
}

inline void spoil(ClauseResult& clause, const std::string& text) {
  clause.id = clause.level = clause.requirement = clause.coverage = clause.reason = text;
  spoil(clause.mark, text);
  spoil(clause.evidence, text);
  for (LimitRow& limit : clause.limits) {
    limit.quantity = limit.geometry = limit.unit = text;
    spoil(limit.evidence, text);
    spoil(limit.mark, text);
  }
  for (SetupEffects& effects : clause.effects) {
    effects.geometry = text;
    for (LadderRow& row : effects.rows) {
      row.sample = row.title = text;
    }
  }
}

inline void spoil(Footprint& footprint, const std::string& text) {
  footprint.geometry = footprint.sample = text;
  for (FootprintOutline& outline : footprint.outlines) {
    outline.title = text;
  }
}

inline ConformanceReport hostile_report(const std::string& text) {
  ConformanceReport report = example_report();
  report.standard_id = report.title = report.edition = report.transcription = text;
  report.notes = report.device = report.device_detail = report.decision_rule = text;
  report.version = report.date = text;
  report.sources = {{text, text}};
  for (ClauseResult& clause : report.clauses) {
    spoil(clause, text);
  }
  for (CaseResult& result : report.cases) {
    spoil(result, text);
  }
  for (WeightingCurve& curve : report.weightings) {
    curve.title = text;
  }
  for (Footprint& footprint : report.footprints) {
    spoil(footprint, text);
  }
  return report;
}

}  // namespace gonio::test

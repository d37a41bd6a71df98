#include <fmt/format.h>

#include "reports/conformance_report.hpp"
#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"

namespace gonio {

namespace {

std::string row(std::initializer_list<std::string> cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += fmt::format(" {} |", markdown_text(cell));
  }
  return text + "\n";
}

std::string head(const ConformanceReport& report) {
  std::string text =
      fmt::format("# Conformance to {}\n\n{}\n\n**Verdict: {}.** {}\n\n",
                  markdown_text(report.standard_id), "Title: " + markdown_text(report.title),
                  verdict_words(report.verdict), markdown_text(verdict_meaning(report)));
  for (const std::string& warning : warnings(report)) {
    text += fmt::format("- {}\n", markdown_text(warning));
  }
  text += "\n| | |\n|---|---|\n";
  text += row({"device", report.device});
  text += row({"found at", report.device_detail});
  text += row({"edition", report.edition});
  text += row({"decision rule", report.decision_rule});
  text += row({"gonio", report.version});
  text += row({"date", report.date});
  return text + row({"seed", fmt::format("{}", report.seed)});
}

std::string clause_table(const ConformanceReport& report) {
  std::string text = fmt::format("\n## Clauses\n\n{}.\n\n", markdown_text(clause_counts(report)));
  text += "| clause | level | verdict | limit | evidence | cases | place |\n";
  text += "|---|---|---|---|---|---|---|\n";
  for (const ClauseResult& clause : report.clauses) {
    text += row({clause.id, level_text(report, clause), verdict_words(clause.verdict),
                 limits_text(clause), evidence_text(clause.evidence), coverage_text(clause),
                 place_text(clause.mark)});
  }
  return text;
}

/// Observations, and the message if there is one, in one cell.
std::string evidence_cell(const CaseResult& result) {
  std::string text = result.message;
  for (const Observation& observation : result.observations) {
    text += (text.empty() ? "" : "; ") + observation_text(observation);
  }
  return text;
}

std::string case_table(const ConformanceReport& report) {
  std::string text = fmt::format("\n## Cases\n\n{}.\n\n", markdown_text(case_counts(report)));
  text += "| case | tried | verdict | observed | place |\n|---|---|---|---|---|\n";
  for (const CaseResult& result : report.cases) {
    text +=
        row({fmt::format("{}/{}", result.clause, result.id),
             result.subject.empty() ? role_name(result.role)
                                    : fmt::format("{}: {}", role_name(result.role), result.subject),
             found_text(result), evidence_cell(result), place_text(result.mark)});
  }
  return text;
}

std::string source_list(const ConformanceReport& report) {
  std::string text = report.sources.empty() ? "" : "\n## Sources\n\n";
  for (const auto& [key, what] : report.sources) {
    text += fmt::format("- source {}: {}\n", markdown_text(key), markdown_text(what));
  }
  return text;
}

}  // namespace

std::string conformance_markdown(const ConformanceReport& report) {
  return head(report) + clause_table(report) + case_table(report) + source_list(report);
}

}  // namespace gonio

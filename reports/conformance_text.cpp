#include <fmt/format.h>

#include <algorithm>

#include "reports/conformance_report.hpp"
#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"

namespace gonio {

namespace {

std::string bold(const std::string& text, bool styled) {
  return styled ? fmt::format("\033[1m{}\033[0m", text) : text;
}

std::string head(const ConformanceReport& report, bool styled) {
  std::string text = fmt::format("{} - {}\n{}", one_line(report.standard_id),
                                 one_line(report.title), one_line(report.device));
  if (!report.device_detail.empty()) {
    text += fmt::format("; {}", one_line(report.device_detail));
  }
  text +=
      fmt::format("\ndecision rule: {}; seed {}\n\n", one_line(report.decision_rule), report.seed);
  text += fmt::format("{}: {}\n", bold(verdict_words(report.verdict), styled),
                      one_line(verdict_meaning(report)));
  for (const std::string& warning : warnings(report)) {
    text += one_line(warning) + "\n";
  }
  return text;
}

std::string clause_table(const ConformanceReport& report, bool styled) {
  std::size_t width = 6;
  for (const ClauseResult& clause : report.clauses) {
    width = std::max(width, one_line(clause.id).size());
  }
  std::string text =
      fmt::format("\n{:<{}}  {:<19}  {:<14}  {}\n", "clause", width, "level", "verdict", "cases");
  for (const ClauseResult& clause : report.clauses) {
    const std::string row =
        fmt::format("{:<{}}  {:<19}  {:<14}  {}", one_line(clause.id), width,
                    one_line(level_text(report, clause)), verdict_words(clause.verdict),
                    one_line(coverage_text(clause)));
    text += bold(row, styled && clause.verdict == ConformanceVerdict::fail) + "\n";
  }
  return text;
}

std::string case_block(const CaseResult& result) {
  std::string text = fmt::format("\n{}: {}\n  {}\n", one_line(result.address), found_text(result),
                                 one_line(result.intent));
  if (!result.message.empty()) {
    text += fmt::format("  {}\n", one_line(result.message));
  }
  for (const Observation& observation : result.observations) {
    text += fmt::format("  {}: {}\n", verdict_words(observation.verdict),
                        one_line(observation_text(observation)));
  }
  return text + fmt::format("  {}\n", one_line(place_text(result.mark)));
}

}  // namespace

std::string conformance_text(const ConformanceReport& report, bool styled) {
  std::string text = head(report, styled) + clause_table(report, styled);
  for (const CaseResult& result : report.cases) {
    if (!result.is_as_expected()) {
      text += case_block(result);
    }
  }
  return text +
         fmt::format("\n{}\n{}\n", one_line(clause_counts(report)), one_line(case_counts(report)));
}

}  // namespace gonio

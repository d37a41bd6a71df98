#include "reports/conformance_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gonio {

namespace {

std::string plural(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::size_t count_of(const ConformanceReport& report, ConformanceVerdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(report.clauses.begin(), report.clauses.end(),
                    [&](const ClauseResult& clause) { return clause.verdict == verdict; }));
}

/// Ids of the clauses that count and have that verdict.
std::vector<std::string> counted_clauses(const ConformanceReport& report,
                                         ConformanceVerdict verdict) {
  std::vector<std::string> ids;
  for (const ClauseResult& clause : report.clauses) {
    if (is_counted(report, clause) && clause.verdict == verdict) {
      ids.push_back(clause.id);
    }
  }
  return ids;
}

/// ": a, b" or nothing.
std::string listed(const std::vector<std::string>& ids) {
  return ids.empty() ? "" : fmt::format(": {}", fmt::join(ids, ", "));
}

}  // namespace

const char* role_name(CaseRole role) {
  return role == CaseRole::device ? "device" : role == CaseRole::control ? "control" : "evaluation";
}

std::string verdict_words(ConformanceVerdict verdict) {
  return verdict == ConformanceVerdict::not_applicable ? "not applicable" : verdict_name(verdict);
}

std::string verdict_meaning(const ConformanceReport& report) {
  const std::string clauses = listed(counted_clauses(report, report.verdict));
  switch (report.verdict) {
    case ConformanceVerdict::pass:
      return "Every clause that counts and could be tried is met, as far as its cases show.";
    case ConformanceVerdict::fail:
      return fmt::format("At least one clause that counts is not met{}.", clauses);
    case ConformanceVerdict::inconclusive:
      return fmt::format("At a limit, the uncertainty is too large to tell{}.", clauses);
    case ConformanceVerdict::not_applicable:
      return "No clause concerns this device, or no number of them is known.";
    case ConformanceVerdict::skipped:
      return "No clause could be tried on this device.";
    case ConformanceVerdict::error:
      break;
  }
  return fmt::format("The device no longer answered, or the suite is at fault{}.", clauses);
}

std::vector<std::string> warnings(const ConformanceReport& report) {
  std::vector<std::string> sentences;
  if (report.transcription != "complete") {
    sentences.push_back(
        fmt::format("The transcription of this standard is {}: no claim of conformity may be made.",
                    report.transcription.empty() ? "not stated" : report.transcription));
  }
  const auto informative = static_cast<std::size_t>(
      std::count_if(report.clauses.begin(), report.clauses.end(),
                    [](const ClauseResult& clause) { return clause.evidence.is_informative(); }));
  if (informative > 0) {
    sentences.push_back(fmt::format("{} known only from memory: informative, not counted.",
                                    plural(informative, "clause")));
  }
  const auto wrong = static_cast<std::size_t>(
      std::count_if(report.cases.begin(), report.cases.end(), [](const CaseResult& result) {
        return result.role != CaseRole::device && !result.is_as_expected();
      }));
  if (wrong > 0) {
    sentences.push_back(fmt::format(
        "{} not come out as expected: the verdicts of those clauses cannot be relied on.",
        wrong == 1 ? "1 control does" : fmt::format("{} controls do", wrong)));
  }
  sentences.emplace_back(report.should_counts ? "Recommendations (should) count."
                                              : "Recommendations (should) do not count.");
  return sentences;
}

std::string clause_counts(const ConformanceReport& report) {
  std::vector<std::string> parts;
  for (const ConformanceVerdict verdict : all_verdicts) {
    if (const std::size_t count = count_of(report, verdict); count > 0) {
      parts.push_back(fmt::format("{} {}", count, verdict_words(verdict)));
    }
  }
  return plural(report.clauses.size(), "clause") + listed(parts);
}

std::string case_counts(const ConformanceReport& report) {
  const auto good = static_cast<std::size_t>(
      std::count_if(report.cases.begin(), report.cases.end(),
                    [](const CaseResult& result) { return result.is_as_expected(); }));
  return fmt::format("{}: {} as expected, {} not", plural(report.cases.size(), "case"), good,
                     report.cases.size() - good);
}

bool is_counted(const ConformanceReport& report, const ClauseResult& clause) {
  return clause.counts && !clause.evidence.is_informative() &&
         (clause.level == "shall" || (clause.level == "should" && report.should_counts));
}

std::string level_text(const ConformanceReport& report, const ClauseResult& clause) {
  return is_counted(report, clause) ? clause.level : clause.level + ", not counted";
}

std::string coverage_text(const ClauseResult& clause) {
  if (!clause.cases.empty()) {
    return plural(clause.cases.size(), "case");
  }
  const std::string coverage = clause.coverage == "out_of_scope" ? "out of scope"
                               : clause.coverage == "cases"      ? ""
                                                                 : clause.coverage;
  const bool has_both = !coverage.empty() && !clause.reason.empty();
  return fmt::format("no case{}{}{}{}", coverage.empty() ? "" : ", ", coverage,
                     has_both || !clause.reason.empty() ? ": " : "", clause.reason);
}

std::string evidence_text(const Evidence& evidence) {
  return evidence.sources.empty()
             ? evidence.level
             : fmt::format("{} [{}]", evidence.level, fmt::join(evidence.sources, ", "));
}

std::string limits_text(const ClauseResult& clause) {
  std::vector<std::string> parts;
  for (const LimitRow& limit : clause.limits) {
    parts.push_back(fmt::format("{}: {}", limit_name(limit), limit_text(limit)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string limit_places_text(const ClauseResult& clause) {
  std::vector<std::string> places;
  for (const LimitRow& limit : clause.limits) {
    places.push_back(place_text(limit.mark));
  }
  return fmt::format("{}", fmt::join(places, "; "));
}

std::string found_text(const CaseResult& result) {
  std::string found = verdict_words(result.verdict);
  if (result.role == CaseRole::device && result.expected == ConformanceVerdict::pass) {
    return found;
  }
  return result.is_as_expected()
             ? found + ", as expected"
             : fmt::format("{}, expected {}", found, verdict_words(result.expected));
}

const char* quantity_name(const SetupEffects& effects) {
  return setup_quantity_names.at(static_cast<std::size_t>(effects.quantity));
}

}  // namespace gonio

#pragma once

#include <array>
#include <string>
#include <vector>

#include "reports/conformance_report.hpp"
#include "reports/limit_words.hpp"

// How a conformance report is put into words, the same in every format. Nothing is escaped here.

namespace gonio {

inline constexpr std::array all_verdicts{
    ConformanceVerdict::pass,         ConformanceVerdict::fail,
    ConformanceVerdict::inconclusive, ConformanceVerdict::not_applicable,
    ConformanceVerdict::skipped,      ConformanceVerdict::error};

/// e.g. "not applicable".
[[nodiscard]] std::string verdict_words(ConformanceVerdict verdict);
/// What the verdict on the device means, in a sentence.
[[nodiscard]] std::string verdict_meaning(const ConformanceReport& report);
/// What a reader must know before using the verdict, a sentence each.
[[nodiscard]] std::vector<std::string> warnings(const ConformanceReport& report);
/// e.g. "3 clauses: 2 pass, 1 fail".
[[nodiscard]] std::string clause_counts(const ConformanceReport& report);
/// e.g. "4 cases: 3 as expected, 1 not".
[[nodiscard]] std::string case_counts(const ConformanceReport& report);

/// Whether the clause has a say in the verdict on the device.
[[nodiscard]] bool is_counted(const ConformanceReport& report, const ClauseResult& clause);
/// The level, and whether the clause has a say, e.g. "shall", "should, not counted".
[[nodiscard]] std::string level_text(const ConformanceReport& report, const ClauseResult& clause);
/// How many cases there are, or why there is none.
[[nodiscard]] std::string coverage_text(const ClauseResult& clause);
/// e.g. "C2 [IT14, JK]".
[[nodiscard]] std::string evidence_text(const Evidence& evidence);
/// All limits of a clause in a line.
[[nodiscard]] std::string limits_text(const ClauseResult& clause);
/// Where they stand, in the same order.
[[nodiscard]] std::string limit_places_text(const ClauseResult& clause);

/// What was found of whom, e.g. "fail, as expected", "pass, expected fail".
[[nodiscard]] std::string found_text(const CaseResult& result);
/// The name of a quantity of the set-up, e.g. theta_i.
[[nodiscard]] const char* quantity_name(const SetupEffects& effects);

}  // namespace gonio

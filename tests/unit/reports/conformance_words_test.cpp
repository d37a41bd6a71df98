#include "reports/conformance_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/reports/example_report.hpp"

namespace gonio {
namespace {

using enum ConformanceVerdict;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(FoundText, TellsWhetherAControlDidAsItShould) {
  CaseResult result{.role = CaseRole::control, .verdict = fail, .expected = fail};
  EXPECT_EQ(found_text(result), "fail, as expected");
  result.verdict = pass;
  EXPECT_EQ(found_text(result), "pass, expected fail");
  EXPECT_EQ(found_text(CaseResult{.role = CaseRole::device, .verdict = skipped}), "skipped");
}

TEST(Warnings, ForbidAClaimWhereTheTranscriptionIsPartial) {
  ConformanceReport report = test::example_report();
  EXPECT_THAT(warnings(report), Contains(HasSubstr("no claim of conformity may be made")));
  report.transcription = "complete";
  EXPECT_THAT(warnings(report), Not(Contains(HasSubstr("no claim of conformity may be made"))));
}

TEST(Warnings, TellOfClausesKnownFromMemory) {
  ConformanceReport report = test::example_report();
  EXPECT_THAT(warnings(report),
              Contains("1 clause known only from memory: informative, not counted."));
  for (ClauseResult& clause : report.clauses) {
    clause.evidence.level = "C2";
  }
  EXPECT_THAT(warnings(report), Not(Contains(HasSubstr("memory"))));
}

TEST(Warnings, TellOfControlsThatDidNotComeOutAsTheyShould) {
  ConformanceReport report = test::example_report();
  EXPECT_THAT(warnings(report), Not(Contains(HasSubstr("control"))));
  report.cases.at(2).verdict = pass;  // of offset_beyond_limit
  EXPECT_THAT(warnings(report), Contains(testing::StartsWith("1 control does not come out")));
}

TEST(VerdictMeaning, NamesTheClausesThatCountAndNoOthers) {
  const std::string meaning = verdict_meaning(test::example_report());
  EXPECT_THAT(meaning, HasSubstr("geometry/incidence_60"));
  EXPECT_THAT(meaning, Not(HasSubstr("geometry/source_60")));  // from memory
}

TEST(LevelText, SaysWhatDoesNotCount) {
  ConformanceReport report;
  ClauseResult clause{.level = "should"};
  EXPECT_EQ(level_text(report, clause), "should, not counted");
  report.should_counts = true;
  EXPECT_EQ(level_text(report, clause), "should");
  clause.counts = false;
  EXPECT_EQ(level_text(report, clause), "should, not counted");
}

TEST(CoverageText, SaysWhyThereIsNoCase) {
  ClauseResult clause{.coverage = "out_of_scope", .reason = "a person does it"};
  EXPECT_EQ(coverage_text(clause), "no case, out of scope: a person does it");
  clause.coverage = "inspection";
  clause.reason.clear();
  EXPECT_EQ(coverage_text(clause), "no case, inspection");
  clause.cases = {0};
  EXPECT_EQ(coverage_text(clause), "1 case");
}

TEST(Counts, AddUp) {
  const ConformanceReport report = test::example_report();
  EXPECT_EQ(clause_counts(report),
            "8 clauses: 1 pass, 2 fail, 1 inconclusive, 2 not applicable, 1 skipped, 1 error");
  EXPECT_EQ(case_counts(report), "9 cases: 4 as expected, 5 not");
}

TEST(VerdictName, IsTheOneOfTheContract) {
  const std::vector<std::string> names{"pass",           "fail",    "inconclusive",
                                       "not_applicable", "skipped", "error"};
  for (std::size_t i = 0; i < all_verdicts.size(); ++i) {
    EXPECT_EQ(verdict_name(all_verdicts.at(i)), names.at(i));
  }
}

}  // namespace
}  // namespace gonio

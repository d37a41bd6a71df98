#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/hostile_report.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Bars of a row that part its cells.
std::ptrdiff_t bars(const std::string& row) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    count += row[i] == '|' && (i == 0 || row[i - 1] != '\\') ? 1 : 0;
  }
  return count;
}

TEST(ConformanceMarkdown, ListsClausesWithoutCasesAndWhy) {
  EXPECT_THAT(conformance_markdown(test::example_report()),
              HasSubstr("| report/contents | shall | not applicable |  | C1 \\[TOC14\\] | no case, "
                        "inspection: a report is read by a person |"));
}

TEST(ConformanceMarkdown, HasTwoTablesWhoseRowsAreOfOneWidthWhateverStandsInThem) {
  const ConformanceReport report = test::hostile_report(test::hostile_text("trace"));
  std::istringstream in(conformance_markdown(report));
  constexpr std::ptrdiff_t clause_bars = 8;
  constexpr std::ptrdiff_t case_bars = 6;
  std::size_t clauses = 0;
  std::size_t cases = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("|")) {
      clauses += bars(line) == clause_bars ? 1 : 0;
      cases += bars(line) == case_bars ? 1 : 0;
    }
  }
  EXPECT_EQ(clauses, report.clauses.size() + 2);  // head and rule
  EXPECT_EQ(cases, report.cases.size() + 2);
}

TEST(ConformanceMarkdown, HoldsHostileTextAsText) {
  const std::string text = conformance_markdown(test::hostile_report(test::hostile_text("trace")));
  EXPECT_THAT(text, Not(HasSubstr("<script")));
  EXPECT_THAT(text, Not(HasSubstr("\n# head")));
  EXPECT_THAT(text, HasSubstr("\\`touch trace\\`"));
  EXPECT_THAT(text, HasSubstr("\\[d\\](e)"));
}

}  // namespace
}  // namespace gonio

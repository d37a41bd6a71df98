#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/hostile_report.hpp"

// That it is well-formed, with hostile text too, is seen by an XML parser in tests/pages.

namespace gonio {
namespace {

using enum ConformanceVerdict;
using testing::HasSubstr;
using testing::Not;

/// The example with its first case of that role and verdict, and nothing else.
ConformanceReport report_of(CaseRole role, ConformanceVerdict verdict, ConformanceVerdict expected,
                            bool counts = true) {
  ConformanceReport report = test::example_report();
  report.clauses.resize(1);
  report.clauses.front().cases = {0};
  report.clauses.front().counts = counts;
  CaseResult& result = report.cases.front();
  result.role = role;
  result.verdict = verdict;
  result.expected = expected;
  return report;
}

TEST(ConformanceJunit, CountsWhatItHolds) {
  EXPECT_THAT(
      conformance_junit(test::example_report()),
      HasSubstr(
          R"(<testsuites name="iso_2813/2014" tests="9" failures="2" errors="1" skipped="2")"));
}

TEST(ConformanceJunit, PointsAtTheYamlLineOfEachCase) {
  EXPECT_THAT(conformance_junit(test::example_report()),
              HasSubstr(R"(<testcase name="as_stated" )"
                        R"(classname="iso_2813/2014/geometry/incidence_60" )"
                        R"(file="standards/cases/geometry.yaml" line="12" time="0.012">)"));
}

TEST(ConformanceJunit, HasClauseVerdictLevelEvidenceAndPlaceAsProperties) {
  const std::string xml = conformance_junit(test::example_report());
  for (const char* property :
       {R"(name="clause" value="geometry/incidence_60")", R"(name="verdict" value="fail")",
        R"(name="level" value="shall")", R"(name="evidence" value="C2 [IT14, JK]")",
        R"(name="limit" value="theta_i at 60: 60 +- 0.1 deg")",
        R"(name="limit_place" value="standards/iso_2813/2014/standard.yaml:41")"}) {
    EXPECT_THAT(xml, HasSubstr(std::string("<property ") + property + "/>"));
  }
}

TEST(ConformanceJunit, FailsWhatDidNotComeOutAsItShould) {
  EXPECT_THAT(conformance_junit(report_of(CaseRole::device, fail, pass)), HasSubstr("<failure "));
  EXPECT_THAT(conformance_junit(report_of(CaseRole::control, pass, fail)), HasSubstr("<failure "));
  EXPECT_THAT(conformance_junit(report_of(CaseRole::device, inconclusive, pass)),
              HasSubstr("<failure "));
  EXPECT_THAT(conformance_junit(report_of(CaseRole::device, error, pass)), HasSubstr("<error "));
  EXPECT_THAT(conformance_junit(report_of(CaseRole::device, skipped, pass)),
              HasSubstr("<skipped "));
}

TEST(ConformanceJunit, PassesAControlThatIsCaught) {
  EXPECT_THAT(conformance_junit(report_of(CaseRole::control, fail, fail)),
              HasSubstr(R"(tests="1" failures="0" errors="0" skipped="0")"));
}

TEST(ConformanceJunit, SkipsADeviceThatMissesWhatDoesNotCount) {
  const std::string xml = conformance_junit(report_of(CaseRole::device, fail, pass, false));
  EXPECT_THAT(xml, HasSubstr(R"(<skipped message="informative, not counted: fail">)"));
  EXPECT_THAT(xml, Not(HasSubstr("<failure")));
  EXPECT_THAT(conformance_junit(report_of(CaseRole::control, pass, fail, false)),
              HasSubstr("<failure "));
}

TEST(ConformanceJunit, HoldsHostileTextAsText) {
  const std::string xml = conformance_junit(test::hostile_report(test::hostile_text("trace")));
  EXPECT_THAT(xml, Not(HasSubstr("<script")));
  EXPECT_THAT(xml, Not(HasSubstr("]]>")));
  EXPECT_THAT(xml, Not(HasSubstr("\x1B")));
  EXPECT_THAT(xml, HasSubstr("&lt;script&gt;"));
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <system_error>

#include "emulator/core/text_file.hpp"
#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"
#include "tests/unit/reports/hostile_report.hpp"

// How it looks, and that its filter works, is seen by a browser in tests/pages.

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a pattern's group matches, each time.
std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex); it != std::sregex_iterator();
       ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

TEST(ConformancePage, OpensWithTheVerdictAndWhatMayBeClaimed) {
  const std::string page = conformance_page(test::example_report());
  const auto verdict = page.find("Verdict: ");
  const auto warning = page.find("no claim of conformity may be made");
  const auto table = page.find("<table");
  EXPECT_LT(verdict, warning);
  EXPECT_LT(warning, table);
  EXPECT_NE(table, std::string::npos);
}

TEST(ConformancePage, HasEveryClauseAndEveryCase) {
  const ConformanceReport report = test::example_report();
  const std::string page = conformance_page(report);
  EXPECT_EQ(all_of(page, "(data-kind=\"clause\")").size(), report.clauses.size());
  EXPECT_EQ(all_of(page, "(data-kind=\"case\")").size(), report.cases.size());
}

TEST(ConformancePage, HasAnEndForEachLinkAndEachIdOnce) {
  for (const ConformanceReport& report :
       {test::example_report(), test::hostile_report(test::hostile_text("trace"))}) {
    const std::string page = conformance_page(report);
    const auto ids = all_of(page, "\\sid=[\"']([^\"']*)[\"']");
    const std::set<std::string> unique(ids.begin(), ids.end());
    if (report.device == test::example_report().device) {
      EXPECT_EQ(unique.size(), ids.size());  // all hostile texts are the same
    }
    const auto links = all_of(page, "<a href=\"#([^\"]*)\"");
    EXPECT_GT(links.size(), report.cases.size());
    for (const std::string& link : links) {
      EXPECT_TRUE(unique.contains(link)) << link;
    }
  }
}

TEST(ConformancePage, ListsSourcesThatNobodyDescribed) {
  ConformanceReport report = test::example_report();
  report.sources.erase("JK");
  EXPECT_THAT(conformance_page(report),
              HasSubstr("<dt id=\"source-JK\">JK</dt><dd>not described</dd>"));
}

TEST(ConformancePage, ShowsPlacesOfCasesAndLimits) {
  const std::string page = conformance_page(test::example_report());
  EXPECT_THAT(page, HasSubstr("standards/cases/geometry.yaml:12"));
  EXPECT_THAT(page, HasSubstr("standards/iso_2813/2014/standard.yaml:41"));
}

TEST(ConformancePage, AsksForNothingFromOutside) {
  const std::string page = conformance_page(test::example_report());
  for (const std::string& address : all_of(page, "(?:src|href|url)[=(][\"']?([a-z]+):")) {
    EXPECT_EQ(address, "data");  // pictures inside
  }
}

TEST(ConformancePage, HoldsHostileTextAsText) {
  const std::string page = conformance_page(test::hostile_report(test::hostile_text("trace")));
  EXPECT_EQ(all_of(page, "(<script)").size(), 1u);  // the filter
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(page, HasSubstr("{{title}} {{{svg}}}"));
  EXPECT_THAT(page, Not(HasSubstr("\x1B")));
}

TEST(ConformancePage, LetsNobodyRunHostileText) {
  const test::TemporaryFolder folder;
  const auto trace = folder.path() / "trace";
  (void)conformance_page(test::hostile_report(test::hostile_text(trace)));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(ConformancePage, TellsGnuplotNothingButNumbers) {
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  const std::string word = "hostileword";
  (void)conformance_page(test::hostile_report(word));
  const std::string with_hostile = read_text_file(recorder.folder() / "scripts");
  EXPECT_THAT(with_hostile, HasSubstr("$outlines << END_OF_NUMBERS\n"));
  EXPECT_THAT(with_hostile, Not(HasSubstr(word)));
  std::filesystem::remove(recorder.folder() / "scripts");
  (void)conformance_page(test::example_report());
  EXPECT_EQ(read_text_file(recorder.folder() / "scripts"), with_hostile);
}

TEST(ConformancePage, IsThereWithoutChartsAndWithoutClauses) {
  ConformanceReport report;
  report.verdict = ConformanceVerdict::skipped;
  const std::string page = conformance_page(report);
  EXPECT_THAT(page, HasSubstr("No clause could be tried"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
}

TEST(ConformancePage, DrawsWhatItCanOfNumbersThatAreNone) {
  ConformanceReport report = test::example_report();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::fill(report.footprints.front().radiance.begin(), report.footprints.front().radiance.end(),
            nan);
  for (LadderRow& row : report.clauses.front().effects.front().rows) {
    row.low_gu = row.high_gu = nan;
  }
  for (WeightingCurve& curve : report.weightings) {
    std::fill(curve.weight.begin(), curve.weight.end(), nan);
  }
  report.footprints.push_back({.geometry = "20", .sample = "nothing"});
  EXPECT_THAT(conformance_page(report), HasSubstr("</html>"));
}

TEST(ConformancePage, IsAnErrorOfTheEnvironmentWithoutGnuplot) {
  const test::TemporaryFolder nothing;
  const test::SearchPath path(nothing.path().string());
  EXPECT_THROW((void)conformance_page(test::example_report()), std::system_error);
}

}  // namespace
}  // namespace gonio

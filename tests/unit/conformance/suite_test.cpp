#include "tests/conformance/suite.hpp"

#include <gmock/gmock.h>

#include "tests/unit/conformance/suite_files.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using test::message_of;
using test::shipped;
using test::SuiteFiles;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string incidence =
    "  - id: geometry/incidence\n"
    "    each: geometry\n"
    "    level: shall\n"
    "    requirement: The beam comes in at the nominal angle.\n"
    "    limits: [{quantity: theta_i}]\n"
    "    coverage: cases\n";

std::string incidence_case(const std::string& id, const std::string& verdict) {
  return "  - {id: " + id +
         ", clause: geometry/incidence, intent: Tried., given: {instrument: nominal}, when: "
         "{measure: theta_i}, verdict: " +
         verdict + "}\n";
}
const std::string accepts = incidence_case("nominal", "pass");
const std::string rejects = incidence_case("beyond", "fail");

std::vector<std::string> addresses_of(const ConformanceSuite& suite) {
  std::vector<std::string> addresses;
  for (const SuiteCase& entry : suite.cases) {
    addresses.push_back(entry.address);
  }
  return addresses;
}

std::vector<std::string> ids_of(const std::vector<SuiteSelection>& selections) {
  std::vector<std::string> ids;
  for (const SuiteSelection& selection : selections) {
    ids.push_back(load_clauses(selection.clauses_file, shipped()).id);
  }
  return ids;
}

TEST(Suite, GivesEachCaseAnAddressInEachGeometry) {
  EXPECT_THAT(
      addresses_of(SuiteFiles(incidence, accepts + rejects).suite()),
      ElementsAre("house/1/geometry/incidence_20/nominal", "house/1/geometry/incidence_20/beyond",
                  "house/1/geometry/incidence_60/nominal", "house/1/geometry/incidence_60/beyond"));
}

TEST(Suite, LeadsFromACaseToItsClause) {
  const ConformanceSuite suite = SuiteFiles(incidence, accepts + rejects).suite();
  EXPECT_EQ(suite.clause_of(suite.cases[3]).id, "geometry/incidence_60");
  EXPECT_EQ(suite.case_of(suite.cases[3]).id, "beyond");
}

TEST(Suite, WantsOfAShallACaseThatRejects) {
  const SuiteFiles files(incidence, accepts);
  EXPECT_EQ(message_of([&] { (void)files.suite(); }),
            (files.folder() / "clauses.yaml").string() +
                ":5:5: clauses[0]: expected a case that accepts and one that rejects, found 'none "
                "that rejects'");
}

TEST(Suite, WantsOfAShallACaseThatAccepts) {
  const SuiteFiles files(incidence, rejects);
  EXPECT_THAT(message_of([&] { (void)files.suite(); }),
              HasSubstr("clauses.yaml:5:5: clauses[0]: expected a case that accepts and one that "
                        "rejects, found 'none that accepts'"));
}

TEST(Suite, WantsAnyCaseAtAll) {
  EXPECT_THAT(message_of([] { (void)SuiteFiles(incidence).suite(); }), HasSubstr("found 'none'"));
}

TEST(Suite, IsContentWithOneCaseOfAShould) {
  const std::string should = test::replaced(incidence, "level: shall", "level: should");
  EXPECT_EQ(SuiteFiles(should, accepts).suite().cases.size(), 2U);
}

TEST(Suite, WantsNoCaseOfWhatIsInspected) {
  const std::string inspected =
      test::replaced(incidence, "coverage: cases", "coverage: inspection\n    reason: By eye.");
  EXPECT_TRUE(SuiteFiles(inspected).suite().cases.empty());
}

TEST(Suite, NamesTheSamplesThatTheDeviceIsToRead) {
  const std::string glass =
      "  - id: reading/glass\n"
      "    level: may\n"
      "    requirement: Reads glass.\n"
      "    evidence: {level: C2, sources: []}\n"
      "    coverage: cases\n";
  const std::string read = "when: {measure: gloss, sample: black_glass_n1567}";
  const std::string control =
      "given: {instrument: nominal}, when: {measure: gloss, sample: perfect_mirror}";
  const auto of_glass = [](const std::string& id, const std::string& what) {
    return "  - {id: " + id + ", clause: reading/glass, intent: Reads., " + what +
           ", then: {expect: 100 GU, tolerance: 1 GU}, verdict: pass}\n";
  };
  EXPECT_THAT(SuiteFiles(glass, of_glass("read", read) + of_glass("control", control))
                  .suite()
                  .device_samples(),
              ElementsAre("black_glass_n1567"));
}

TEST(SuiteSelection, TakesAllStandards) {
  EXPECT_EQ(select_suites("all", shipped()).size(), shipped().list(Catalog::Kind::clauses).size());
}

TEST(SuiteSelection, TakesAFamily) {
  EXPECT_THAT(ids_of(select_suites("astm_d523", shipped())), ElementsAre("astm_d523/14"));
}

TEST(SuiteSelection, TakesAStandardAsAWhole) {
  const auto selections = select_suites("iso_2813/2014", shipped());
  EXPECT_THAT(ids_of(selections), ElementsAre("iso_2813/2014"));
  EXPECT_EQ(selections.front().prefix, "");
}

TEST(SuiteSelection, TakesAPartOfAStandard) {
  const auto selections = select_suites("iso_2813/2014/geometry/receptor_60", shipped());
  EXPECT_THAT(ids_of(selections), ElementsAre("iso_2813/2014"));
  EXPECT_EQ(selections.front().prefix, "iso_2813/2014/geometry/receptor_60");
}

TEST(SuiteSelection, TakesNoBeginningOfAName) {
  const std::string message = message_of([] { (void)select_suites("iso_28", shipped()); });
  EXPECT_THAT(message, HasSubstr("iso_2813/2014"));
  EXPECT_THAT(message, HasSubstr("or a clause of one"));
}

TEST(IsSelected, HoldsForTheAddressItselfAndBelowIt) {
  const std::string receptor = "iso_2813/2014/geometry/receptor_60";
  EXPECT_TRUE(is_selected(receptor + "/in_plane_nominal", receptor));
  EXPECT_TRUE(is_selected(receptor, receptor));
  EXPECT_TRUE(is_selected(receptor, ""));
  EXPECT_FALSE(is_selected(receptor, "iso_2813/2014/geometry/receptor_6"));
  EXPECT_FALSE(is_selected("iso_2813/2014", receptor));
}

TEST(CoverageTable, CountsTheClausesOfEachKind) {
  const std::string inspected =
      "  - {id: report/contents, level: should, requirement: It is written., evidence: {level: C2, "
      "sources: []}, coverage: inspection, reason: By eye.}\n";
  const std::string remembered =
      "  - id: geometry/receptor_axis\n"
      "    each: geometry\n"
      "    level: shall\n"
      "    requirement: The receptor is aligned.\n"
      "    limits: [{quantity: theta_r}]\n"
      "    coverage: cases\n";
  const auto of_axis = [](std::string text) {
    text = test::replaced(text, "geometry/incidence", "geometry/receptor_axis");
    return test::replaced(text, "measure: theta_i", "measure: theta_r");
  };
  const ConformanceSuite suite = SuiteFiles(incidence + inspected + remembered,
                                            accepts + rejects + of_axis(accepts) + of_axis(rejects))
                                     .suite();
  EXPECT_THAT(coverage_table({suite}),
              HasSubstr("\n| `house/1` | 5 | 4 | 4 | 4 | 1 | 0 | 0 | 2 |\n"));
}

}  // namespace
}  // namespace gonio::conformance

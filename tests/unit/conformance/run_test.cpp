#include "tests/conformance/run.hpp"

#include <gmock/gmock.h>

#include "tests/unit/conformance/fake_port.hpp"
#include "tests/unit/conformance/suite_files.hpp"

namespace gonio::conformance {
namespace {

using test::FakePort;
using test::SuiteFiles;
using testing::HasSubstr;
using enum ConformanceVerdict;

/// A clause on the reading of glass. @param level, evidence  of the clause.
std::string glass_clause(const std::string& id, const std::string& level = "shall",
                         const std::string& evidence = "C2") {
  return "  - id: " + id + "\n    level: " + level +
         "\n    requirement: Reads glass.\n    limits: [{quantity: gloss, nominal: 100 GU, "
         "tolerance: 1 GU, evidence: {level: " +
         evidence + ", sources: []}}]\n    coverage: cases\n";
}

std::string device_case(const std::string& clause,
                        const std::string& sample = "black_glass_n1567") {
  return "  - {id: of_device, clause: " + clause +
         ", intent: Reads., when: {measure: gloss, sample: " + sample + "}, verdict: pass}\n";
}

/// A control that comes out as stated: the nominal instrument reads its glass, and 100 GU less.
std::string control(const std::string& clause, const std::string& id, const std::string& expect,
                    const std::string& verdict) {
  return "  - {id: " + id + ", clause: " + clause +
         ", intent: Tried., given: {instrument: nominal, set: {as_built: {\"60\": {source: "
         "{in_plane: 0.75 deg}}}}}, when: {measure: gloss, sample: black_glass_n1567}, then: "
         "{expect: {\"20\": " +
         expect + "}}, verdict: " + verdict + "}\n";
}
std::string both_controls(const std::string& clause) {
  return control(clause, "accepted", "100 GU", "pass") +
         control(clause, "rejected", "0 GU", "fail");
}

/// A device that reads `gloss_gu` on glass; always the same bench.
struct Glass {
  explicit Glass(double gloss_gu) {
    port.laid["black_glass_n1567"] = {.gloss_gu = {gloss_gu, gloss_gu, gloss_gu}};
  }
  [[nodiscard]] DeviceUnderTest device() {
    return {.bench = [this] { return std::make_shared<Bench>(test::bench_with(port)); },
            .title = "fake"};
  }
  FakePort port;
};

ConformanceReport report_on(const std::string& clauses, const std::string& cases, Glass& glass,
                            const RunOptions& options = {}, const std::string& prefix = {}) {
  ConformanceRun run(SuiteFiles(clauses, cases).suite(), glass.device(), options, test::shipped());
  for (const SuiteCase& entry : run.suite().cases) {
    if (is_selected(entry.address, prefix)) {
      (void)run.run(entry);
    }
  }
  return run.report(prefix);
}

RunOptions counting_should() {
  RunOptions options;
  options.should_counts = true;
  return options;
}
const RunOptions should_counts = counting_should();

TEST(Run, AcceptsADeviceWithinTheLimits) {
  Glass good(100.2);
  const auto report = report_on(glass_clause("a"), device_case("a") + both_controls("a"), good);
  EXPECT_EQ(report.verdict, pass);
  EXPECT_EQ(report.clauses[0].verdict, pass);
  EXPECT_EQ(report.cases.size(), 3U);
  EXPECT_EQ(report.cases[0].subject, "gonio fake");
}

TEST(Run, RejectsADeviceBeyondTheLimits) {
  Glass bad(103.0);
  const auto report = report_on(glass_clause("a"), device_case("a") + both_controls("a"), bad);
  EXPECT_EQ(report.verdict, fail);
  EXPECT_EQ(report.cases[0].verdict, fail);
  EXPECT_EQ(report.cases[0].observations.size(), 3U);
}

TEST(Run, LeavesOpenWhatUncertaintyDoesNotDecide) {
  Glass close(100.98);
  EXPECT_EQ(report_on(glass_clause("a"), device_case("a") + both_controls("a"), close).verdict,
            pass);  // a display of 0.01 GU
  close.port.laid["black_glass_n1567"].scatter = {-0.5, 0.0, 0.5};
  EXPECT_EQ(report_on(glass_clause("a"), device_case("a") + both_controls("a"), close).verdict,
            inconclusive);
}

TEST(Run, DoesNotCountWhatIsOnlyRemembered) {
  Glass bad(103.0);
  const auto report = report_on(glass_clause("a", "shall", "memory") + glass_clause("b"),
                                device_case("a") + both_controls("a") + both_controls("b"), bad);
  EXPECT_FALSE(report.clauses[0].counts);
  EXPECT_EQ(report.clauses[0].verdict, fail);
  EXPECT_NE(report.verdict, fail);
}

TEST(Run, CountsAShouldOnlyIfAsked) {
  Glass bad(103.0);
  const std::string clauses = glass_clause("a", "should");
  EXPECT_EQ(report_on(clauses, device_case("a"), bad).verdict, not_applicable);
  EXPECT_EQ(report_on(clauses, device_case("a"), bad, should_counts).verdict, fail);
}

TEST(Run, NeverCountsAMay) {
  Glass bad(103.0);
  const auto report = report_on(glass_clause("a", "may"), device_case("a"), bad, should_counts);
  EXPECT_EQ(report.clauses[0].verdict, fail);
  EXPECT_EQ(report.verdict, not_applicable);
}

TEST(Run, IsAnErrorWhereAControlDoesNotComeOutAsStated) {
  Glass good(100.0);
  const std::string wrong =
      control("a", "accepted", "100 GU", "pass") + control("a", "rejected", "100 GU", "fail");
  const auto report = report_on(glass_clause("a"), device_case("a") + wrong, good);
  EXPECT_EQ(report.cases[2].verdict, pass);
  EXPECT_EQ(report.clauses[0].verdict, error);
  EXPECT_EQ(report.verdict, error);
}

TEST(Run, IsAnErrorWhereAControlOfAnInformativeClauseDoesNotComeOutAsStated) {
  Glass good(100.0);
  const auto report =
      report_on(glass_clause("a", "informative"), control("a", "rejected", "100 GU", "fail"), good);
  EXPECT_EQ(report.verdict, error);
}

TEST(Run, SkipsACaseWhoseSampleIsNotThere) {
  Glass good(100.0);
  const auto report = report_on(glass_clause("a", "may"), device_case("a", "perfect_mirror"), good);
  EXPECT_EQ(report.cases[0].verdict, skipped);
  EXPECT_EQ(report.cases[0].message, "there is no perfect_mirror");
  EXPECT_EQ(report.clauses[0].verdict, skipped);
}

TEST(Run, FailsADeviceThatRefuses) {
  Glass dark(100.0);
  dark.port.refusals[DeviceCommand::calibrate] = DeviceError::tile_out_of_tolerance;
  const auto report = report_on(glass_clause("a"), device_case("a") + both_controls("a"), dark);
  EXPECT_EQ(report.cases[0].verdict, fail);
  EXPECT_EQ(report.cases[0].message, "the device does not calibrate: the tile is out of tolerance");
}

TEST(Run, GoesOnWhenTheDeviceIsLost) {
  Glass gone(100.0);
  gone.port.is_lost = true;
  const auto report = report_on(glass_clause("a") + glass_clause("b", "may"),
                                device_case("a") + both_controls("a") + device_case("b"), gone);
  ASSERT_EQ(report.cases.size(), 4U);
  EXPECT_EQ(report.cases[0].verdict, error);
  EXPECT_EQ(report.cases[0].message, "it no longer answers");
  EXPECT_EQ(report.cases[1].verdict, pass);
  EXPECT_EQ(report.cases[2].verdict, fail);
  EXPECT_EQ(report.cases[3].verdict, error);
  EXPECT_EQ(report.verdict, error);
}

TEST(Run, TakesAnEvaluationThatDoesNotComeOutAsStatedForAFailure) {
  Glass good(100.0);
  const std::string clause =
      "  - {id: scale/value, level: may, requirement: By Fresnel., evidence: {level: C2, sources: "
      "[]}, coverage: cases}\n";
  const std::string value =
      "  - {id: value, clause: scale/value, intent: By index., when: {measure: assigned_value, n: "
      "1.567}, then: {expect: 90 GU, tolerance: 1 GU}, verdict: pass}\n";
  const auto report = report_on(clause, value, good);
  EXPECT_EQ(report.cases[0].role, CaseRole::evaluation);
  EXPECT_EQ(report.clauses[0].verdict, fail);
  EXPECT_TRUE(good.port.log.empty());
}

TEST(Run, AcceptsAnEvaluationThatIsToFail) {
  Glass good(100.0);
  const std::string clause =
      "  - {id: scale/value, level: may, requirement: By Fresnel., evidence: {level: C2, sources: "
      "[]}, coverage: cases}\n";
  const std::string value =
      "  - {id: value, clause: scale/value, intent: By index., when: {measure: assigned_value, n: "
      "1.567}, then: {expect: 90 GU, tolerance: 1 GU}, verdict: fail}\n";
  EXPECT_EQ(report_on(clause, value, good).clauses[0].verdict, pass);
}

TEST(Run, ReportsTheSelectedPartAlone) {
  Glass good(100.0);
  const std::string cases =
      device_case("a") + both_controls("a") + device_case("b") + both_controls("b");
  const auto report =
      report_on(glass_clause("a") + glass_clause("b"), cases, good, {}, "house/1/b");
  ASSERT_EQ(report.clauses.size(), 1U);
  EXPECT_EQ(report.clauses[0].id, "b");
  EXPECT_EQ(report.cases.size(), 3U);
}

TEST(Run, CannotJudgeWhatTheStandardLeavesUnknown) {
  Glass good(100.0);
  const std::string source =
      "  - id: geometry/source\n"
      "    each: geometry\n"
      "    level: may\n"
      "    requirement: The image has its size.\n"
      "    limits: [{quantity: source_in_plane}]\n"
      "    coverage: cases\n";
  const std::string of_device =
      "  - {id: of_device, clause: geometry/source, intent: Stated., when: {measure: "
      "source_in_plane}, verdict: pass}\n";
  const auto report = report_on(source, of_device, good);
  ASSERT_EQ(report.clauses.size(), 2U);
  EXPECT_EQ(report.clauses[1].id, "geometry/source_60");
  EXPECT_EQ(report.clauses[1].verdict, not_applicable);
}

TEST(Run, NeedsAServerForAnExchange) {
  ConformanceSuite suite{.set = {.id = "wire/1"}};
  suite.set.clauses.push_back(
      {.id = "read", .family = "read", .level = "shall", .coverage = "cases"});
  Case stated;
  stated.exchange = YamlNode::parse("measure: exchange", "when.yaml");
  suite.stated.push_back(stated);
  suite.cases.push_back({.address = "wire/1/read/known", .clause = 0, .stated = 0});
  ConformanceRun without(suite, {}, {}, Catalog());
  EXPECT_EQ(without.run(suite.cases[0]).verdict, skipped);
  EXPECT_THAT(without.run(suite.cases[0]).message, HasSubstr("--device modbus://"));
}

}  // namespace
}  // namespace gonio::conformance

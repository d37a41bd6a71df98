#include "tests/conformance/case.hpp"

#include <gtest/gtest.h>

#include "emulator/instrument/setup.hpp"
#include "tests/unit/conformance/suite_files.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using test::message_of;
using test::SuiteFiles;

const std::string clauses =
    "  - id: geometry/incidence\n"
    "    each: geometry\n"
    "    level: shall\n"
    "    requirement: The beam comes in at the nominal angle.\n"
    "    limits: [{quantity: theta_i}]\n"
    "    coverage: cases\n"
    "  - id: reading/glass\n"
    "    level: may\n"
    "    requirement: Reads glass.\n"
    "    evidence: {level: C2, sources: []}\n"
    "    coverage: cases\n";

const std::string beyond =
    "  - id: beyond\n"
    "    clause: geometry/incidence\n"
    "    intent: Aimed too high.\n"
    "    given: {instrument: nominal, deviate: {theta_i: 1.5}, uncertainty: {theta_i: 0.2}}\n"
    "    when: {measure: theta_i}\n"
    "    verdict: fail\n";

TEST(Cases, WithAnInstrumentAreControls) {
  const std::vector<Case> cases = SuiteFiles(clauses, beyond).cases();
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0].role, CaseRole::control);
  EXPECT_EQ(cases[0].expected, ConformanceVerdict::fail);
  EXPECT_EQ(cases[0].mark.line, 3);
}

TEST(Cases, WithoutOneTryTheDevice) {
  const std::vector<Case> cases =
      SuiteFiles(clauses,
                 "  - {id: read, clause: reading/glass, intent: Reads., when: {measure: gloss, "
                 "sample: black_glass_n1567}, then: {expect: 100 GU, tolerance: 1 GU}, verdict: "
                 "pass}\n")
          .cases();
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0].role, CaseRole::device);
  EXPECT_EQ(cases[0].samples, std::set<std::string>{"black_glass_n1567"});
}

TEST(Cases, OfEvaluationsNeedNoDevice) {
  const std::vector<Case> cases =
      SuiteFiles(
          clauses,
          "  - {id: value, clause: reading/glass, intent: By index., when: {measure: "
          "assigned_value, n: 1.5}, then: {expect: {fresnel: {n: 1.5}}, tolerance: 0.01 GU}, "
          "verdict: pass}\n")
          .cases();
  EXPECT_EQ(cases.at(0).role, CaseRole::evaluation);
}

TEST(Cases, OfClausesThatTheStandardHasNotAreLeftOut) {
  EXPECT_TRUE(SuiteFiles(clauses).cases().empty());
}

TEST(GivenInstrument, DeviatesByTolerancesOfTheClausesGeometry) {
  const SuiteFiles files(clauses, beyond);
  const ClauseSet set = files.clauses();
  const Instrument instrument =
      given_instrument(*files.cases().at(0).given, set, set.clauses.at(1), test::shipped());
  const auto at_60 = as_built(instrument, "60", SetupQuantity::theta_i);
  EXPECT_TRUE(test::is_close(at_60->value.degrees(), 60.15, 1e-12));
  EXPECT_TRUE(test::is_close(at_60->expanded_uncertainty.degrees(), 0.02, 1e-12));
  const auto at_20 = as_built(instrument, "20", SetupQuantity::theta_i);
  EXPECT_TRUE(test::is_close(at_20->value.degrees(), 20.0, 1e-12));
}

TEST(GivenInstrument, LaysKeysOfAnInstrumentFileOverIt) {
  const SuiteFiles files(
      clauses, test::replaced(beyond, "deviate: {theta_i: 1.5}, uncertainty: {theta_i: 0.2}",
                              "set: {repeatability: 0.2 GU}"));
  const ClauseSet set = files.clauses();
  const Instrument instrument =
      given_instrument(*files.cases().at(0).given, set, set.clauses.at(0), test::shipped());
  EXPECT_DOUBLE_EQ(instrument.behaviour.repeatability_gu, 0.2);
}

std::string error_with(const std::string& from, const std::string& to) {
  const SuiteFiles files(clauses, test::replaced(beyond, from, to));
  std::string message = message_of([&] { (void)files.cases(); });
  const auto at = message.find("cases.yaml");
  return at == std::string::npos ? message : message.substr(at);
}

TEST(CaseErrors, TellPlaceAndKey) {
  EXPECT_EQ(error_with("verdict: fail", "verdict: failed"),
            "cases.yaml:8:14: cases[0].verdict: expected one of pass, fail, inconclusive, "
            "not_applicable, found 'failed'");
  EXPECT_EQ(
      error_with("{theta_i: 1.5}", "{theta: 1.5}"),
      "cases.yaml:6:51: cases[0].given.deviate.theta: expected a quantity of the set-up, e.g. "
      "theta_i or receptor_in_plane, found 'theta'");
  EXPECT_EQ(error_with("instrument: nominal, ", ""),
            "cases.yaml:6:22: cases[0].given.deviate: expected an `instrument` to lay it over: the "
            "device under test is as it is, found 'a map'");
  EXPECT_EQ(error_with("    given: {instrument: nominal, deviate: {theta_i: 1.5}, uncertainty: "
                       "{theta_i: 0.2}}\n",
                       ""),
            "cases.yaml:7:14: cases[0].verdict: expected pass: the device under test is not known "
            "to fail; a control has a `given`, found 'fail'");
  EXPECT_EQ(error_with("measure: theta_i", "measure: gloss, sample: unobtainium"),
            "cases.yaml:3:5: cases[0].when: expected samples that fixtures/samples has, found "
            "'unobtainium'");
  EXPECT_TRUE(error_with("measure: theta_i", "measure: weight")
                  .starts_with("cases.yaml:7:21: cases[0].when.measure: expected one of exchange, "
                               "assigned_value, "));
  EXPECT_TRUE(
      error_with("measure: theta_i", "measure: theta_i, readings: 3")
          .starts_with("cases.yaml:7:30: cases[0].when.readings: expected one of the keys"));
}

TEST(CaseErrors, OfAnOverlayTellItsPlace) {
  const SuiteFiles files(
      clauses, test::replaced(beyond, "deviate: {theta_i: 1.5}, uncertainty: {theta_i: 0.2}",
                              "set: {behaviour: {linearity: much}}"));
  const ClauseSet set = files.clauses();
  const std::string message = message_of([&] {
    (void)given_instrument(*files.cases().at(0).given, set, set.clauses.at(0), test::shipped());
  });
  EXPECT_NE(message.find("cases.yaml:6:"), std::string::npos) << message;
  EXPECT_NE(message.find("behaviour.linearity: expected"), std::string::npos) << message;
}

}  // namespace
}  // namespace gonio::conformance

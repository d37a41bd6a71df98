#include "emulator/standard/clause.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/clause_files.hpp"

namespace gonio {
namespace {

using test::ClauseFiles;
using test::message_of;

const std::string incidence =
    "  - id: geometry/incidence\n"
    "    each: geometry\n"
    "    level: shall\n"
    "    requirement: The beam comes in at the nominal angle.\n"
    "    limits: [{quantity: theta_i}]\n"
    "    coverage: cases\n";

TEST(Clauses, OfEachGeometryTakeTheirNumbersFromTheStandard) {
  const ClauseFiles files(incidence);
  const ClauseSet set = files.clauses();
  ASSERT_EQ(set.clauses.size(), 2U);
  EXPECT_EQ(set.clauses[0].id, "geometry/incidence_20");
  EXPECT_EQ(set.clauses[1].id, "geometry/incidence_60");
  const LimitRow* limit = set.clauses[1].limit("theta_i");
  ASSERT_NE(limit, nullptr);
  EXPECT_DOUBLE_EQ(*limit->nominal, 60.0);
  EXPECT_DOUBLE_EQ(*limit->low, 59.9);
  EXPECT_DOUBLE_EQ(*limit->high, 60.1);
  EXPECT_EQ(limit->unit, "deg");
  EXPECT_EQ(limit->evidence.level, "C2");
  EXPECT_TRUE(limit->mark.file.ends_with("standard.yaml")) << limit->mark.file;
}

TEST(Clauses, CanBeOfSomeGeometries) {
  const ClauseFiles files(
      test::replaced(incidence, "    level", "    geometries: [\"60\"]\n    level"));
  ASSERT_EQ(files.clauses().clauses.size(), 1U);
  EXPECT_EQ(files.clauses().clauses[0].id, "geometry/incidence_60");
}

TEST(Clauses, AreAsSureAsTheirWeakestNumber) {
  const ClauseFiles files(test::replaced(incidence, "theta_i}", "theta_i}, {quantity: theta_r}"));
  EXPECT_EQ(files.clauses().clauses[0].evidence.level, "memory");
}

TEST(Clauses, AreLeftOutWhereTheGeometryHasNoSuchQuantity) {
  const ClauseFiles files(test::replaced(incidence, "theta_i", "receptor_diameter"));
  EXPECT_TRUE(files.clauses().clauses.empty());
}

TEST(Clauses, OfAnUnknownNumberAreNotApplicable) {
  const ClauseFiles files(test::replaced(incidence, "theta_i", "source_in_plane"));
  const ClauseSet set = files.clauses();
  ASSERT_EQ(set.clauses.size(), 2U);
  EXPECT_EQ(set.clauses[0].not_applicable, "");
  EXPECT_EQ(set.clauses[1].not_applicable, "source_in_plane is not known for this geometry");
}

TEST(Clauses, StateLimitsOfTheirOwn) {
  const ClauseFiles files(
      "  - id: photometry/linearity\n"
      "    level: shall\n"
      "    requirement: Linear.\n"
      "    limits: [{quantity: linearity, nominal: 0, tolerance: 0.01, evidence: {level: C1, "
      "sources: [W523]}}]\n"
      "    coverage: cases\n");
  const ClauseSet set = files.clauses();
  const LimitRow* limit = set.clauses.at(0).limit("linearity");
  ASSERT_NE(limit, nullptr);
  EXPECT_DOUBLE_EQ(*limit->high, 0.01);
  EXPECT_EQ(limit->evidence.sources, std::vector<std::string>{"W523"});
}

/// The message without the folder.
std::string error_with(const std::string& clause) {
  const ClauseFiles files(clause);
  std::string message = message_of([&] { (void)files.clauses(); });
  const auto at = message.find("clauses.yaml");
  return at == std::string::npos ? message : message.substr(at);
}

TEST(ClauseErrors, TellPlaceAndKey) {
  EXPECT_EQ(error_with(test::replaced(incidence, "shall", "must")),
            "clauses.yaml:7:12: clauses[0].level: expected one of shall, should, may, informative, "
            "found 'must'");
  EXPECT_EQ(error_with(test::replaced(incidence, "geometry/incidence", "Geometry/Incidence")),
            "clauses.yaml:5:9: clauses[0].id: expected letters a to z, digits and '_' in parts "
            "joined by '/', found 'Geometry/Incidence'");
  EXPECT_EQ(error_with(test::replaced(incidence, "    each: geometry\n", "")),
            "clauses.yaml:8:14: clauses[0].limits[0]: expected `each: geometry` in the clause of a "
            "set-up quantity, found 'a map'");
  EXPECT_EQ(error_with(test::replaced(incidence, "coverage: cases", "coverage: inspection")),
            "clauses.yaml:5:5: clauses[0].reason: expected the key 'reason', found 'only id, each, "
            "level, "
            "requirement, limits, coverage'");
  EXPECT_EQ(error_with(incidence + incidence),
            "clauses.yaml:11:5: clauses[1]: expected each clause once, found 'geometry/incidence'");
  EXPECT_EQ(error_with(test::replaced(incidence, "{quantity: theta_i}", "{quantity: zero}")),
            "clauses.yaml:9:14: clauses[0].limits[0]: expected nominal and tolerance, at_least or "
            "at_most, found 'a map'");
}

}  // namespace
}  // namespace gonio

#include "emulator/standard/profile_rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::shipped;
using test::TemporaryFolder;
using testing::HasSubstr;

constexpr double rounding = 1e-12;

ProfileRules shipped_rules(const std::string& id) {
  return load_profile_rules(shipped().find(Catalog::Kind::profile, id), shipped());
}

const std::string head =
    "schema: gonio/profile_rules/1\n"
    "id: house/1\n"
    "title: House rules\n"
    "notes: Ours.\n"
    "rules:\n";
const std::string doi =
    "  - id: doi\n"
    "    title: distinctness\n"
    "    doi: {offset: {nominal: 0.3 deg, evidence: {level: C1, sources: []}}, evidence: {level: "
    "memory, sources: []}}\n";

std::string error_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.file("profile.yaml", text);
  return message_of([&] { (void)load_profile_rules(file, shipped()); });
}

TEST(ShippedProfileRules, HaveTheIdOfTheirFolderAndNotes) {
  const auto ids = test::ids_of_shipped(Catalog::Kind::profile);
  EXPECT_THAT(ids, testing::IsSupersetOf(
                       {"astm_d5767/95", "astm_e430/11", "iso_13803/2014", "jis_k_7374/2007"}));
  for (const std::string& id : ids) {
    const ProfileRules rules = shipped_rules(id);
    EXPECT_EQ(rules.id, id);
    EXPECT_FALSE(rules.title.empty()) << id;
    EXPECT_FALSE(rules.notes.empty()) << id;
    for (const ProfileRule& rule : rules.rules) {
      EXPECT_EQ(rule.standard, id);
      EXPECT_TRUE(!rule.evidence.sources.empty() || rule.evidence.is_informative()) << rule.id;
    }
  }
}

TEST(ProfileRules, TakeTheirFieldsFromTheGeometriesOfTheStandard) {
  const ProfileRule haze = shipped_rules("iso_13803/2014").rules.front();
  EXPECT_EQ(haze.kind, ProfileRule::Kind::haze);
  EXPECT_FALSE(haze.is_mean);
  EXPECT_NEAR(haze.theta_i->degrees(), 20.0, rounding);
  ASSERT_EQ(haze.fields.size(), 2u);
  EXPECT_NEAR(haze.fields[0].offset.degrees(), -1.9, rounding);
  EXPECT_NEAR(haze.fields[1].offset.degrees(), 1.9, rounding);
  EXPECT_NEAR(haze.fields[0].width->degrees(), 1.8, rounding);
  EXPECT_FALSE(shipped_rules("astm_e430/11").rules.front().fields[0].width);
}

TEST(ProfileRules, OfDistinctnessLieOnBothSides) {
  const ProfileRule rule = shipped_rules("astm_d5767/95").rules.front();
  EXPECT_EQ(rule.kind, ProfileRule::Kind::doi);
  EXPECT_FALSE(rule.theta_i);
  ASSERT_EQ(rule.fields.size(), 2u);
  EXPECT_NEAR(rule.fields[0].offset.degrees(), -0.3, rounding);
  EXPECT_NEAR(rule.fields[1].offset.degrees(), 0.3, rounding);
}

TEST(ProfileRules, OfTheCombHaveItsWidths) {
  EXPECT_THAT(shipped_rules("jis_k_7374/2007").rules.front().comb_mm,
              testing::Pointwise(testing::DoubleNear(rounding), {0.125, 0.25, 0.5, 1.0, 2.0}));
}

TEST(ProfileRules, HaveTheWeakestEvidence) {
  const TemporaryFolder folder;
  const auto file = folder.file("profile.yaml", head + doi);
  EXPECT_EQ(load_profile_rules(file, shipped()).rules.front().evidence.level, "memory");
}

TEST(ProfileRules, AreRefusedWithTheirPlace) {
  EXPECT_THAT(error_of(head + doi + doi), HasSubstr(":9:9: rules[1].id: expected each rule once"));
  EXPECT_THAT(error_of(head + replaced(doi, "0.3 deg", "0 deg")),
              HasSubstr("expected an angle (deg, rad, mrad) in (0, 90]"));
  EXPECT_THAT(error_of(head + "  - {id: a, title: A}\n"), HasSubstr("'clarity'"));
  EXPECT_THAT(
      error_of(head + "  - id: log\n    title: L\n    logarithmic: {of: haze, factor: {nominal: 1, "
                      "evidence: {level: C1, sources: []}}, divisor: {nominal: 1, evidence: "
                      "{level: C1, sources: []}}}\n"),
      HasSubstr("expected a haze that stands before it, found 'haze'"));
  EXPECT_THAT(
      error_of(head + "  - id: c\n    title: C\n    clarity: {combs: [0 mm], evidence: {level: "
                      "C1, sources: []}}\n"),
      HasSubstr("combs[0]: expected a length"));
}

TEST(ProfileRules, NameGeometriesThatAreThere) {
  const TemporaryFolder folder;
  (void)folder.file("standard.yaml", test::user_standard());
  const auto file = folder.file(
      "profile.yaml",
      head +
          "  - id: h\n    title: H\n    haze: {at: \"60\", fields: [\"61\"], combine: sum, "
          "evidence: {level: C1, sources: []}}\n");
  EXPECT_THAT(message_of([&] { (void)load_profile_rules(file, shipped()); }),
              HasSubstr("fields[0]: expected a geometry of house/1, found '61'"));
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using test::contents;
using test::Outcome;
using test::Program;
using test::with;
using testing::HasSubstr;

std::string error_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

TEST(ProfileCommand, GivesTheQuantitiesOfItsReference) {
  const Outcome outcome = Program().run({"profile", "clearcoat_hazy", "clearcoat_orange_peel"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, contents(test::source_tree / "reports/reference/profile.txt"));
}

// The fine scratches of the hazy one scatter far from the mirror direction, its polish does not.
TEST(ProfileCommand, TellsAHazySampleFromOneWithOrangePeelByItsTail) {
  const Outcome outcome =
      Program().run({"profile", "clearcoat_hazy", "clearcoat_orange_peel", "--format", "json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json profile = json::parse(outcome.out);
  EXPECT_EQ(profile["schema"], "gonio/profile/1");
  ASSERT_EQ(profile["angle_deg"].size(), 512u);
  EXPECT_EQ(profile["angle_deg"][0], -7.23576);
  const json& hazy = profile["measurements"][0];
  const json& smooth = profile["measurements"][1];
  EXPECT_EQ(hazy["quantities"][0]["id"], "gloss_20");
  EXPECT_EQ(hazy["quantities"].size(), 10u);
  EXPECT_GT(hazy["gu_per_deg"][0].get<double>(), 2.0 * smooth["gu_per_deg"][0].get<double>());
}

TEST(ProfileCommand, ReportIsAPageAndTheSameJsonAndCsvAsArePrinted) {
  const Program program;
  const std::vector<std::string> command{"profile", "clearcoat_hazy"};
  const Outcome outcome = program.run(with(command, {"--report", "r", "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto folder = program.folder() / "r";
  EXPECT_EQ(contents(folder / "profile.json"), outcome.out);
  EXPECT_EQ(contents(folder / "profile.csv"), program.run(with(command, {"--format", "csv"})).out);
  const std::string page = contents(folder / "profile.html");
  EXPECT_THAT(page, HasSubstr("<h1>In-plane profile of clearcoat_hazy</h1>"));
  EXPECT_THAT(page, HasSubstr("shaded: the fields of haze"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

TEST(ProfileCommand, AtAnotherAngleHasTheQuantitiesOfThatAngle) {
  const Outcome outcome =
      Program().run({"profile", "black_high_gloss", "--angle", "30 deg", "--reach", "16 deg"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("haze, method C, wide"));
  EXPECT_THAT(outcome.out, HasSubstr("distinctness of image, method C"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("iso_13803")));
}

TEST(ProfileCommand, SaysWhyAValueIsMissing) {
  const Outcome outcome = Program().run({"profile", "black_high_gloss", "--reach", "1 deg"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no haze, linear: a field lies beyond the profile"));
}

TEST(ProfileCommand, RefusesWhatItCannotDo) {
  EXPECT_THAT(error_of({"profile"}), HasSubstr("samples"));
  EXPECT_THAT(error_of({"profile", "nonexistent"}), HasSubstr("expected a sample file"));
  const auto with_option = [](const std::string& name, const std::string& value) {
    return error_of({"profile", "black_satin", name, value});
  };
  EXPECT_EQ(with_option("--angle", "85 deg"),
            "gonio: --angle 85 deg, --reach 7.25 deg, --step 0.02832 deg: profile: expected a row "
            "that ends before 90 deg, found one up to 92.25 deg\n");
  EXPECT_THAT(with_option("--step", "1e-9 deg"), HasSubstr("expected 2 to 20000 elements"));
  EXPECT_THAT(with_option("--slit", "0 deg"), HasSubstr("--slit: expected an angle"));
  EXPECT_THAT(with_option("--comb-distance", "1 deg"),
              HasSubstr("--comb-distance: expected a length (nm, um, mm) in [1, 10000] mm, found "
                        "'1 deg'"));
}

}  // namespace
}  // namespace gonio

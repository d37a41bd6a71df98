#include "reports/profile_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "reports/profile_words.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Elements of 1 deg.
Profile profile_of(const std::vector<double>& flux) {
  const auto n = Eigen::Index(flux.size());
  const double reach = 0.5 * degrees(double(n)).radians();
  return {.edge_rad = Eigen::ArrayXd::LinSpaced(n + 1, -reach, reach),
          .flux = Eigen::Map<const Eigen::ArrayXd>(flux.data(), n)};
}

struct Made {
  Standard standard = test::shipped_standard("iso_2813/2014");
  std::vector<ProfileMeasurement> measurements;

  explicit Made(const std::string& sample) {
    measurements.push_back(
        {.sample = sample,
         .sample_title = "Title",
         .profile = profile_of({0.0, 0.03, 0.01}),
         .quantities = {
             {.standard = "house/1", .id = "a", .title = "sure", .value = 12.345, .unit = "GU"},
             {.standard = "house/1", .id = "b", .title = "lost", .missing = "no light"},
             {.standard = "house/1",
              .id = "c",
              .title = "assumed",
              .value = 1.0,
              .assumption = "a lens"},
             {.standard = "house/1",
              .id = "d",
              .title = "recalled",
              .value = -1e-12,
              .evidence = {.level = "memory", .sources = {}}}}});
  }
  [[nodiscard]] ProfileHeader header() const {
    return {.standard = standard,
            .setup = {.step = degrees(1), .reach = degrees(1.5)},
            .assumptions = {},
            .rules = {},
            .reference = profile_of({0.0, 0.05, 0.0})};
  }
};

TEST(ProfileText, SaysWhatIsInformativeAndWhatIsMissing) {
  const Made made("paint");
  const std::string text = profile_text(made.header(), made.measurements, false);
  EXPECT_THAT(text, HasSubstr("12.35"));
  EXPECT_THAT(text, Not(HasSubstr("-0.00")));
  EXPECT_THAT(text, HasSubstr("paint: no lost: no light\n"));
  EXPECT_THAT(text, HasSubstr("informative, assuming a lens: assumed\n"));
  EXPECT_THAT(text, HasSubstr("informative, known from memory alone: recalled\n"));
}

TEST(ProfileDensity, IsGlossPerDegree) {
  constexpr double rounding = 1e-12;
  const Made made("paint");
  const Eigen::ArrayXd density =
      profile_density(made.measurements.front().profile, made.header().reference);
  EXPECT_NEAR(density(1), 60.0, 60.0 * rounding);
  EXPECT_NEAR(density(2), 20.0, 20.0 * rounding);
  EXPECT_EQ(profile_angles(made.header().reference)(0), -1.0);
}

TEST(ProfileJson, MarksWhatIsInformative) {
  const Made made("paint");
  const json profile = json::parse(profile_json(made.header(), made.measurements));
  EXPECT_EQ(profile["schema"], "gonio/profile/1");
  EXPECT_EQ(profile["angle_deg"], (json{-1.0, 0.0, 1.0}));
  const json& quantities = profile["measurements"][0]["quantities"];
  EXPECT_EQ(quantities[0]["informative"], false);
  EXPECT_EQ(quantities[2]["informative"], true);
  EXPECT_EQ(quantities[3]["informative"], true);
  EXPECT_TRUE(quantities[1]["value"].is_null());
  EXPECT_EQ(quantities[1]["missing"], "no light");
}

TEST(ProfileCsv, HasARowForEachElement) {
  const Made made("my, paint");
  const std::string csv = profile_csv(made.header(), made.measurements);
  EXPECT_THAT(csv, HasSubstr("angle_deg,\"my, paint\"\n-1,0\n0,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
}

TEST(ProfilePage, EscapesTextOfOthersAndDrawsWithoutFieldsToo) {
  const Made made("<b>paint</b>");
  const std::string page = profile_page(made.header(), made.measurements);
  EXPECT_THAT(page, Not(HasSubstr("<b>paint")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;paint"));
  EXPECT_THAT(page, Not(HasSubstr("shaded")));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

}  // namespace
}  // namespace gonio

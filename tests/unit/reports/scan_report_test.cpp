#include "reports/scan_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Two wavelengths and three positions, one of which is blocked.
struct Example {
  ScanPlan plan;
  ScanResult result;
  Example() {
    plan.grid = WavelengthGrid(nanometres(500), nanometres(100), 2);
    plan.theta_i = {degrees(40)};
    plan.theta_r = {degrees(-40), degrees(0), degrees(40)};
    using enum PositionState;
    result.positions = plan.positions();
    result.state = {blocked, measured, reciprocal};
    result.f_r.resize(2, 3);
    result.f_r << nothing, 0.25, 2.0, nothing, 0.75, 4.0;
    result.error = Eigen::Array3d(nothing, 1e-5, 1e-4);
    result.omega_r = Eigen::Array3d(0.1, 0.2, 0.1);
    result.light = {.source = Eigen::Array2d(0.5, 0.5), .weight = Eigen::Array2d(0.5, 0.5)};
    result.evaluations = 1;
  }
  [[nodiscard]] ScanReport report() const {
    return {.sample = "mine",
            .sample_title = "Mine <b>",
            .plan = plan,
            .result = result,
            .lobes = scan_lobes(result)};
  }
};

template <class Write>
std::string written(const Example& example, const Write& write) {
  std::string text;
  write(example.report(), [&](std::string_view piece) { text += piece; });
  return text;
}

TEST(ScanCsv, HasARowForEachPosition) {
  EXPECT_THAT(written(Example(), write_scan_csv),
              HasSubstr("theta_i,rotation,theta_r,phi_r,state,omega_r,f_r,error,f_r_500,f_r_600,"
                        "flux_500,flux_600\n"
                        "40,0,-40,0,blocked,0.1,,,,,,\n"
                        "40,0,0,0,measured,0.2,0.5,1e-05,0.25,0.75,0.025,0.075"));
}

TEST(ScanJson, IsOneDocumentWithEveryPosition) {
  const auto json = nlohmann::json::parse(written(Example(), write_scan_json));
  EXPECT_EQ(json["schema"], "gonio/scan_result/1");
  ASSERT_EQ(json["positions"].size(), 3U);
  EXPECT_EQ(json["positions"][0]["state"], "blocked");
  EXPECT_FALSE(json["positions"][0].contains("f_r"));
  EXPECT_EQ(json["positions"][2]["f_r"], nlohmann::json({2.0, 4.0}));
  EXPECT_EQ(json["lobes"][0]["peak"]["theta_r_deg"], 40.0);
  EXPECT_TRUE(json["lobes"][0]["reflectance"].is_null());
}

TEST(ScanText, TellsThePeak) {
  const std::string text = scan_text(Example().report(), false);
  EXPECT_THAT(text, HasSubstr("3: 1 measured, 1 known by reciprocity, 1 out of reach"));
  EXPECT_THAT(text, HasSubstr("0.00       3            -"));
}

TEST(ScanPage, ShowsLobesAndEscapesWhatOthersWrote) {
  const std::string page = scan_page(Example().report());
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("Mine &lt;b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("Mine <b>")));
  EXPECT_THAT(page, HasSubstr("cannot be added up"));
}

}  // namespace
}  // namespace gonio

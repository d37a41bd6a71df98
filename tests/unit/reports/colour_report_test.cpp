#include "reports/colour_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A made-up measurement with the multi-angle instrument.
struct Made {
  Instrument instrument = load_instrument(
      test::shipped().find(Catalog::Kind::instrument, "multi_angle_45"), test::shipped());
  WavelengthGrid grid{nanometres(500), nanometres(50), 2};
  ColourConditions conditions{.illuminant = "d65", .observer = "2"};
  std::vector<ColourMeasurement> measurements;

  explicit Made(const std::string& sample) {
    ColourMeasurement one{.sample = sample, .sample_title = "Title of " + sample};
    one.geometries.push_back({.id = "45_as110",
                              .theta_i = degrees(45),
                              .theta_r = degrees(-65),
                              .aspecular = degrees(110),
                              .reading = {.radiance_factor = Eigen::ArrayXd::LinSpaced(2, 0.5, 2.0),
                                          .quadrature_error = 1e-7},
                              .xyz = {.X = 1.0, .Y = 2.0, .Z = 3.0},
                              .xy = {},
                              .lab = {.L = 40.0, .a = -1e-12, .b = 5.0},
                              .evidence = {.level = "memory", .sources = {}}});
    one.flop = FlopResult{.value = {}, .evidence = {.level = "memory-low", .sources = {}}};
    measurements.push_back(one);
  }
  [[nodiscard]] ColourHeader header() const {
    return {.instrument = instrument, .conditions = conditions, .grid = grid};
  }
};

TEST(ColourText, NamesConditionsGeometriesAndWhatIsInformative) {
  const Made made("paint");
  const std::string text = colour_text(made.header(), made.measurements, false);
  EXPECT_THAT(text, HasSubstr("illuminant D65, 2 deg observer"));
  EXPECT_THAT(text, HasSubstr("110 deg"));
  EXPECT_THAT(text, HasSubstr("40.00"));
  EXPECT_THAT(text, Not(HasSubstr("-0.00")));
  EXPECT_THAT(text, HasSubstr("paint: flop index not defined"));
  EXPECT_THAT(text, HasSubstr("informative: 45_as110: "));
}

TEST(ColourJson, HasNullWhereThereIsNothing) {
  const Made made("paint");
  const json colour = json::parse(colour_json(made.header(), made.measurements));
  EXPECT_EQ(colour["schema"], "gonio/colour/1");
  const json& one = colour["measurements"][0];
  EXPECT_TRUE(one["flop"]["value"].is_null());
  EXPECT_TRUE(one["geometries"][0]["x"].is_null());
  EXPECT_EQ(one["geometries"][0]["theta_r_deg"], -65);
  EXPECT_EQ(one["geometries"][0]["spectrum"]["radiance_factor"], (json{0.5, 2.0}));
}

TEST(ColourCsv, QuotesTextOfOthersAndKeepsItsColumns) {
  const Made made("my, paint");
  const std::string csv = colour_csv(made.header(), made.measurements);
  const std::string head = csv.substr(0, csv.find('\n'));
  EXPECT_THAT(csv, HasSubstr("din_6175_2/2001,\"my, paint\",d65,2,45_as110,45,-65,110,1,2,3,40,"));
  EXPECT_EQ(std::count(head.begin(), head.end(), ','), 15);
  EXPECT_EQ(radiance_factor_csv(made.header(), made.measurements),
            "# radiance factor, din_6175_2/2001, Multi-angle spectrophotometer, 45 deg and five "
            "aspecular angles\nwavelength_nm,\"my, paint 45_as110\"\n500,0.5\n550,2\n");
}

TEST(ColourPage, EscapesTextOfOthers) {
  const Made made("<script>alert(1)</script>");
  const std::string page = colour_page(made.header(), made.measurements);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

}  // namespace
}  // namespace gonio

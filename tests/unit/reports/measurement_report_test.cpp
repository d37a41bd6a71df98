#include "reports/measurement_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using test::shipped_standard;
using testing::HasSubstr;
using testing::Not;

/// A measurement made up for the report: one geometry, two wavelengths.
GeometryResult result(const std::string& id, double gloss) {
  GeometryResult made{.id = id,
                      .theta_i = degrees(std::stod(id)),
                      .reading = {.gloss = gloss,
                                  .quadrature_error = 1.5e-7,
                                  .luminous_reflectance = 0.25,
                                  .reflectance = Eigen::ArrayXd::LinSpaced(2, 0.125, 0.375)},
                      .colour = {},
                      .evidence = {}};
  return made;
}

const WavelengthGrid two_wavelengths(nanometres(500), nanometres(50), 2);

MeasurementHeader header_of(const Standard& standard) {
  return {.standard = standard,
          .instrument = "Some instrument",
          .integrator = "aperture",
          .reference = "reference glass",
          .grid = two_wavelengths};
}

Measurement measurement(const std::string& sample, std::vector<GeometryResult> results) {
  return {.sample = sample, .sample_title = "Title", .geometries = std::move(results)};
}

std::string text_of(const Standard& standard, const std::vector<Measurement>& measurements,
                    bool styled = false) {
  return measurement_text(header_of(standard), measurements, styled);
}

// Text.

TEST(MeasurementText, RoundsAsTheStandardSaysBesideTheComputedValue) {
  const std::vector<Measurement> some{measurement("a", {result("60", 41.0188)})};
  EXPECT_THAT(text_of(shipped_standard("iso_2813/2014"), some),
              testing::ContainsRegex("a +60 +41 +41\\.0188 "));  // nearest unit
  EXPECT_THAT(text_of(shipped_standard("astm_d523/14"), some),
              testing::ContainsRegex("a +60 +41\\.0 +41\\.0188 "));  // no rule found
}

TEST(MeasurementText, RoundsHalvesAwayFromZero) {
  const std::vector<Measurement> some{measurement("a", {result("60", 41.5)})};
  EXPECT_THAT(text_of(shipped_standard("iso_2813/2014"), some),
              testing::ContainsRegex("a +60 +42 +41\\.5000 "));
}

TEST(MeasurementText, MarksTheSelectedGeometry) {
  std::vector<Measurement> some{measurement("a", {result("20", 1.0), result("60", 2.0)})};
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_THAT(text_of(standard, some), Not(HasSubstr("<")));
  some.front().selected_geometry = "60";
  EXPECT_THAT(text_of(standard, some), HasSubstr("<: the geometry that the standard selects\n"));
  EXPECT_THAT(text_of(standard, some), testing::ContainsRegex("a +60 +2 < +2\\.0000"));
  EXPECT_THAT(text_of(standard, some), testing::ContainsRegex("a +20 +1 +1\\.0000"));
}

TEST(MeasurementText, HasEscapesOnlyWhereItIsStyled) {
  std::vector<Measurement> some{measurement("a", {result("60", 2.0)})};
  some.front().selected_geometry = "60";
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_THAT(text_of(standard, some, false), Not(HasSubstr("\033")));
  EXPECT_THAT(text_of(standard, some, true), HasSubstr("\033[1m"));
}

TEST(MeasurementText, ShowsADashWhereThereIsNoColour) {
  const std::vector<Measurement> some{measurement("a", {result("60", 2.0)})};
  EXPECT_THAT(text_of(shipped_standard("iso_2813/2014"), some),
              testing::ContainsRegex("- +- +-\n"));
}

TEST(MeasurementText, NeverShowsAMinusBeforeAZero) {
  Measurement one = measurement("a", {result("60", -1e-9)});
  one.geometries.front().colour =
      ReflectedColour{.xyz = {}, .xy = {}, .lab = {0.0, -1e-15, -1e-15}};
  one.geometries.front().reading.luminous_reflectance = -1e-12;
  one.haze = {{.id = "haze_index", .value = -0.01}};
  EXPECT_THAT(text_of(shipped_standard("iso_2813/2014"), {one}), Not(HasSubstr(" -0")));
}

TEST(MeasurementText, TellsOfHazeAndOfNumbersFromMemory) {
  Measurement one = measurement("a", {result("60", 80.0), result("20", 70.0)});
  one.haze = {{.id = "haze_index", .value = 10.0}};
  one.geometries.front().evidence.level = "memory";
  Measurement other = measurement("b", {result("60", 60.0)});
  other.haze = {{.id = "haze_index", .value = {}}};
  const std::string text = text_of(shipped_standard("astm_d4039/09"), {one, other});
  EXPECT_THAT(text, HasSubstr("a: haze_index 10.0 GU\n"));
  EXPECT_THAT(text, HasSubstr("b: haze_index not defined for it by the standard\n"));
  EXPECT_THAT(text,
              HasSubstr("informative: geometry 60 rests on numbers known only from memory\n"));
}

TEST(MeasurementText, HasRowsOfOneWidth) {
  const std::string text = text_of(shipped_standard("iso_2813/2014"),
                                   {measurement("a", {result("60", 2.0)}),
                                    measurement("a_much_longer_name", {result("20", 1999.25)})});
  EXPECT_THAT(text, HasSubstr("a                         60"));
  EXPECT_THAT(text, HasSubstr("a_much_longer_name        20"));
}

// JSON.

TEST(MeasurementJson, HasTheKeysOfTheContractAndNumbersAtFullPrecision) {
  const double gloss = 41.01880000000001;
  Measurement one = measurement("a", {result("60", gloss)});
  one.selected_geometry = "60";
  const Standard standard = shipped_standard("iso_2813/2014");
  const json read = json::parse(measurement_json(header_of(standard), {one}));
  EXPECT_EQ(read.at("schema"), "gonio/measurement/1");
  EXPECT_EQ(read.at("standard"), "iso_2813/2014");
  EXPECT_EQ(read.at("sample"), "a");
  EXPECT_EQ(read.at("selected_geometry"), "60");
  const json& geometry = read.at("geometries").at(0);
  EXPECT_EQ(geometry.at("id"), "60");
  EXPECT_EQ(geometry.at("theta_i_deg"), 60);
  EXPECT_EQ(geometry.at("gloss_gu").get<double>(), gloss);
  EXPECT_EQ(geometry.at("quadrature_error_gu").get<double>(), 1.5e-7);
  EXPECT_EQ(geometry.at("luminous_reflectance").get<double>(), 0.25);
  EXPECT_EQ(geometry.at("spectrum").at("wavelength_nm"), json({500.0, 550.0}));
  EXPECT_EQ(geometry.at("spectrum").at("reflectance"), json({0.125, 0.375}));
}

TEST(MeasurementJson, ListsSeveralSamples) {
  const Standard standard = shipped_standard("iso_2813/2014");
  const json read =
      json::parse(measurement_json(header_of(standard), {measurement("a", {result("60", 1.0)}),
                                                         measurement("b", {result("60", 2.0)})}));
  EXPECT_EQ(read.at("schema"), "gonio/measurements/1");
  ASSERT_EQ(read.at("measurements").size(), 2u);
  EXPECT_EQ(read.at("measurements").at(1).at("sample"), "b");
  EXPECT_EQ(read.at("measurements").at(1).at("schema"), "gonio/measurement/1");
}

TEST(MeasurementJson, IsNullWhereThereIsNothing) {
  const Standard standard = shipped_standard("astm_d4039/09");
  Measurement one = measurement("a", {result("60", 1.0)});
  one.haze = {{.id = "haze_index", .value = {}}};
  const json read = json::parse(measurement_json(header_of(standard), {one}));
  EXPECT_TRUE(read.at("selected_geometry").is_null());
  EXPECT_TRUE(read.at("geometries").at(0).at("colour").is_null());
  EXPECT_TRUE(read.at("haze").at(0).at("value").is_null());
}

// CSV.

TEST(MeasurementCsv, HasAHeaderAndARowForEachSampleAndGeometry) {
  const Standard standard = shipped_standard("iso_2813/2014");
  Measurement one = measurement("a", {result("20", 1.0), result("60", 2.0)});
  one.selected_geometry = "60";
  EXPECT_EQ(measurement_csv(header_of(standard), {one}),
            "standard,sample,geometry,theta_i_deg,gloss_gu,quadrature_error_gu,"
            "luminous_reflectance,selected,X,Y,Z,L,a,b\n"
            "iso_2813/2014,a,20,20,1,1.5e-07,0.25,0,,,,,,\n"
            "iso_2813/2014,a,60,60,2,1.5e-07,0.25,1,,,,,,\n");
}

TEST(MeasurementCsv, QuotesTextThatHoldsCommasAndQuotes) {
  const Standard standard = shipped_standard("iso_2813/2014");
  const std::string csv =
      measurement_csv(header_of(standard), {measurement("red, \"new\"", {result("20", 1.0)})});
  EXPECT_THAT(csv, HasSubstr("\niso_2813/2014,\"red, \"\"new\"\"\",20,"));
}

TEST(SpectraCsv, QuotesTextThatHoldsCommasAndQuotes) {
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_THAT(spectra_csv(header_of(standard), {measurement("a, b", {result("20", 1.0)})}),
              HasSubstr("\nwavelength_nm,\"a, b 20\"\n"));
}

TEST(SpectraCsv, HasARowForEachWavelengthAndAColumnForEachSampleAndGeometry) {
  const Standard standard = shipped_standard("iso_2813/2014");
  EXPECT_EQ(spectra_csv(header_of(standard), {measurement("a", {result("20", 1.0)}),
                                              measurement("b", {result("60", 2.0)})}),
            "# spectral reflectance into the receptor, iso_2813/2014, Some instrument\n"
            "wavelength_nm,a 20,b 60\n"
            "500,0.125,0.125\n"
            "550,0.375,0.375\n");
}

}  // namespace
}  // namespace gonio

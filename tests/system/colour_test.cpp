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

const std::vector<std::string> colour_of_paint{"colour", "--sample", "silver_effect_paint",
                                               "--instrument", "multi_angle_45"};

std::string error_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

TEST(Colour, IsThatOfItsReference) {
  const Outcome outcome = Program().run(with(colour_of_paint, {"--sample", "red_satin"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, contents(test::source_tree / "reports/reference/colour.txt"));
}

TEST(Colour, IsPrintedAsJsonForEachGeometryWithTheFlopIndex) {
  const Outcome outcome = Program().run(with(colour_of_paint, {"--format", "json"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json colour = json::parse(outcome.out);
  EXPECT_EQ(colour["schema"], "gonio/colour/1");
  EXPECT_EQ(colour["illuminant"], "d65");
  EXPECT_EQ(colour["observer_deg"], 10);
  const json& geometries = colour["measurements"][0]["geometries"];
  ASSERT_EQ(geometries.size(), 5u);
  EXPECT_EQ(geometries[4]["aspecular_deg"], 110);
  EXPECT_EQ(geometries[4]["theta_r_deg"], -65);
  EXPECT_EQ(geometries[0]["spectrum"]["radiance_factor"].size(), 81u);
  EXPECT_GT(colour["measurements"][0]["flop"]["value"], 5.0);
  EXPECT_EQ(colour["measurements"][0]["flop"]["evidence"], "memory-low");
}

TEST(Colour, IsPrintedAsCsvAndItsSpectraToAFile) {
  const Program program;
  const Outcome outcome =
      program.run({"colour", "--sample", "red_satin", "--sample", "white_diffuser", "--instrument",
                   "sphere_8_d", "--format", "csv", "--spectrum", "spectra.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 5);
  EXPECT_THAT(outcome.out, HasSubstr("cie_15/2004,red_satin,d65,10,8_de,8,,,"));
  EXPECT_THAT(contents(program.folder() / "spectra.csv"),
              HasSubstr("wavelength_nm,red_satin 8_di,red_satin 8_de,white_diffuser 8_di,"));
}

TEST(Colour, ReportIsAPageAndTheSameJsonAndCsvAsArePrinted) {
  const Program program;
  const Outcome outcome =
      program.run(with(colour_of_paint, {"--report", "a/b", "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto folder = program.folder() / "a/b";
  EXPECT_EQ(contents(folder / "colour.json"), outcome.out);
  EXPECT_EQ(contents(folder / "colour.csv"),
            program.run(with(colour_of_paint, {"--format", "csv"})).out);
  EXPECT_THAT(contents(folder / "colour.html"),
              HasSubstr("<h1>Colour of silver_effect_paint</h1>"));
  EXPECT_THAT(contents(folder / "colour.html"), HasSubstr("<svg"));
}

TEST(Colour, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(error_of(with(colour_of_paint, {"--illuminant", "f99"})), HasSubstr("--illuminant"));
  EXPECT_THAT(error_of(with(colour_of_paint, {"--observer", "4"})), HasSubstr("--observer"));
  EXPECT_EQ(error_of(with(colour_of_paint, {"--geometry", "45_0"})),
            "gonio: multi_angle_45 has the geometries 45_as15, 45_as25, 45_as45, 45_as75, "
            "45_as110, not '45_0'\n");
  EXPECT_THAT(
      error_of(with(colour_of_paint, {"--tilt", "red"})),
      HasSubstr("--tilt: expected an angle (deg, rad, mrad) in [-45, 45] deg, found 'red'"));
  EXPECT_THAT(error_of(with(colour_of_paint, {"--wavelengths", "200:780:5"})),
              HasSubstr("expected"));
}

// A colorimeter is no glossmeter, and a glossmeter is no colorimeter.

const std::string no_glossmeter =
    "expected an instrument that measures gloss, found 'multi_angle_45', which measures colour by "
    "din_6175_2/2001: see gonio colour\n";

TEST(ColourInstrument, IsRefusedWhereGlossIsMeasured) {
  EXPECT_EQ(error_of({"measure", "--sample", "red_satin", "--instrument", "multi_angle_45"}),
            "gonio: " + no_glossmeter);
  EXPECT_EQ(error_of({"serve", "multi_angle_45", "--tcp", "127.0.0.1:0"}),
            "gonio: " + no_glossmeter);
  EXPECT_EQ(error_of({"certify", "multi_angle_45", "--standard", "iso_2813/2014"}),
            "gonio: " + no_glossmeter);
  EXPECT_THAT(error_of({"measure", "--sample", "red_satin", "--standard", "cie_15/2004"}),
              HasSubstr("found 'Nominal values of cie_15/2004', which measures colour"));
}

TEST(ColourInstrument, IsNoGlossmeter) {
  EXPECT_EQ(error_of({"colour", "--sample", "red_satin", "--instrument", "triangle_gloss"}),
            "gonio: expected an instrument that measures colour, found 'triangle_gloss', which "
            "measures gloss by iso_2813/2014: see gonio measure\n");
}

}  // namespace
}  // namespace gonio

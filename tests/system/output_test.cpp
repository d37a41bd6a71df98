#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/unit/expect_close.hpp"

// What the program prints when all is well.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::is_close;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

constexpr double four_decimals = 1e-3;

std::string output_of(const Program& program, const std::vector<std::string>& arguments) {
  const Outcome outcome = program.run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}
std::string output_of(const std::vector<std::string>& arguments) {
  return output_of(Program(), arguments);
}
json json_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--format", "json"});
  return json::parse(output_of(arguments));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

void expect_gloss(const json& measurement, const std::vector<double>& expected) {
  ASSERT_EQ(measurement.at("geometries").size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const json& geometry = measurement.at("geometries").at(i);
    EXPECT_TRUE(is_close(geometry.at("gloss_gu"), expected[i], four_decimals))
        << measurement.at("sample") << " " << geometry.at("id");
  }
}

// Figures of other programs, through the whole program.

TEST(MeasureProgram, ReadsTheCheckValues) {
  expect_gloss(json_of({"measure", "--sample", "black_glass_n1567"}), {100, 100, 100});
  expect_gloss(json_of({"measure", "--sample", "perfect_mirror"}), {2037.5283, 999.2706, 161.6079});
  expect_gloss(
      json_of({"measure", "--sample", "perfect_mirror", "--instrument", "collimated_iso_2813"}),
      {2037.5686, 999.4400, 161.5122});
  expect_gloss(json_of({"measure", "--sample", "white_diffuser"}), {1.2025, 2.4841, 0.0327});
}

TEST(MeasureProgram, ReadsASampleOfTheUser) {
  const Program program;
  (void)program.file("my paint.yaml",
                     test::sample_text("surface: {model: cook_torrance, rms_slope: 0.02, "
                                       "refractive_index: 1.567}\n"));
  const json measurement =
      json::parse(output_of(program, {"measure", "--sample", "my paint.yaml", "--format", "json"}));
  EXPECT_EQ(measurement.at("sample"), "mine");
  expect_gloss(measurement, {29.8009, 82.1895, 77.6373});
}

TEST(MeasureProgram, ReadsInOneGeometryWithATilt) {
  const json flat = json_of({"measure", "--sample", "perfect_mirror", "--geometry", "20"});
  const json tilted =
      json_of({"measure", "--sample", "perfect_mirror", "--geometry", "20", "--tilt", "0.45 deg"});
  const double share = tilted.at("geometries").at(0).at("gloss_gu").get<double>() /
                       flat.at("geometries").at(0).at("gloss_gu").get<double>();
  EXPECT_TRUE(is_close(share, 0.5, 0.005));
}

TEST(MeasureProgram, UsesTheMethodOfThePaperWhenAsked) {
  const json measurement = json_of({"measure", "--sample", "white_diffuser", "--geometry", "60",
                                    "--integrator", "patches", "--patches", "64"});
  EXPECT_EQ(measurement.at("integrator"), "patches");
  EXPECT_TRUE(is_close(measurement.at("geometries").at(0).at("gloss_gu"), 2.4841, 0.5));
}

// JSON.

TEST(MeasureJson, HasTheKeysOfTheContract) {
  const json measurement = json_of({"measure", "--sample", "copper_polished"});
  EXPECT_EQ(measurement.at("schema"), "gonio/measurement/1");
  EXPECT_EQ(measurement.at("standard"), "iso_2813/2014");
  EXPECT_EQ(measurement.at("sample"), "copper_polished");
  EXPECT_EQ(measurement.at("selected_geometry"), "20");
  ASSERT_EQ(measurement.at("geometries").size(), 3u);
  for (const json& geometry : measurement.at("geometries")) {
    EXPECT_TRUE(geometry.at("id").is_string());
    EXPECT_EQ(geometry.at("theta_i_deg"), std::stod(geometry.at("id").get<std::string>()));
    EXPECT_TRUE(geometry.at("gloss_gu").is_number());
    EXPECT_LE(geometry.at("quadrature_error_gu").get<double>(), 1e-4);
    EXPECT_TRUE(geometry.at("luminous_reflectance").is_number());
    const json& spectrum = geometry.at("spectrum");
    EXPECT_EQ(spectrum.at("wavelength_nm").size(), 81u);
    EXPECT_EQ(spectrum.at("wavelength_nm").front(), 380);
    EXPECT_EQ(spectrum.at("wavelength_nm").back(), 780);
    EXPECT_EQ(spectrum.at("reflectance").size(), 81u);
  }
}

TEST(MeasureJson, IsTheTextBeforeItsRounding) {
  const json measurement = json_of({"measure", "--sample", "red_satin"});
  const std::string text = output_of({"measure", "--sample", "red_satin"});
  for (const json& geometry : measurement.at("geometries")) {
    const auto gloss = geometry.at("gloss_gu").get<double>();
    EXPECT_THAT(text, HasSubstr(fmt::format(" {:.4f} ", gloss)));
    EXPECT_GE(geometry.at("gloss_gu").dump().size(), 15u) << "not at full precision";
  }
}

TEST(MeasureJson, ListsSeveralSamplesInTheirOrder) {
  const json all = json_of(
      {"measure", "--sample", "red_satin", "pmma", "--sample", "n_bk7", "--geometry", "60"});
  EXPECT_EQ(all.at("schema"), "gonio/measurements/1");
  ASSERT_EQ(all.at("measurements").size(), 3u);
  EXPECT_EQ(all.at("measurements").at(0).at("sample"), "red_satin");
  EXPECT_EQ(all.at("measurements").at(2).at("sample"), "n_bk7");
}

// CSV, text and the file of spectra.

TEST(MeasureCsv, HasAHeaderAndARowForEachSampleAndGeometry) {
  const auto lines = lines_of(
      output_of({"measure", "--sample", "red_satin", "--sample", "pmma", "--format", "csv"}));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines.front(),
            "standard,sample,geometry,theta_i_deg,gloss_gu,quadrature_error_gu,"
            "luminous_reflectance,selected,X,Y,Z,L,a,b");
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 13) << line;
  }
}

TEST(MeasureText, HasNoEscapesWhereItIsNoTerminal) {
  EXPECT_THAT(output_of({"measure", "--sample", "red_satin"}), testing::Not(HasSubstr("\033")));
}

TEST(MeasureSpectrum, IsWrittenAsAFile) {
  const Program program;
  (void)output_of(program, {"measure", "--sample", "red_satin", "--spectrum", "spectrum.csv",
                            "--wavelengths", "400:700:100"});
  const auto lines = lines_of(test::contents(program.folder() / "spectrum.csv"));
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_THAT(lines[0], testing::StartsWith("# "));
  EXPECT_EQ(lines[1], "wavelength_nm,red_satin 20,red_satin 60,red_satin 85");
  EXPECT_THAT(lines[2], testing::StartsWith("400,"));
  EXPECT_THAT(lines[5], testing::StartsWith("700,"));
}

// list and glass.

TEST(ListProgram, TellsWhatShipsInThreeFormats) {
  EXPECT_THAT(output_of({"list", "standards"}), HasSubstr("\niso_2813/2014 "));
  EXPECT_THAT(output_of({"list", "samples"}), HasSubstr("\ncopper_polished "));
  EXPECT_THAT(output_of({"list", "instruments"}), HasSubstr("\ntriangle_gloss "));
  EXPECT_THAT(output_of({"list", "batches"}), HasSubstr("\ncoil_coating_60 "));
  for (const char* what : {"standards", "samples", "instruments", "batches"}) {
    const json read = json_of({"list", what});
    EXPECT_EQ(read.at("schema"), "gonio/list/1");
    const auto csv = lines_of(output_of({"list", what, "--format", "csv"}));
    EXPECT_EQ(csv.front(), "id,title,file");
    EXPECT_EQ(csv.size(), read.at(what).size() + 1);
    EXPECT_EQ(lines_of(output_of({"list", what})).size(), read.at(what).size());
    for (const json& row : read.at(what)) {
      EXPECT_TRUE(fs::is_regular_file(row.at("file").get<std::string>())) << row;
      EXPECT_FALSE(row.at("title").get<std::string>().empty());
    }
  }
}

TEST(GlassProgram, AssignsTheValuesOfD523) {
  const json read = json_of({"glass", "--index", "1.527", "--standard", "astm_d523/14"});
  EXPECT_EQ(read.at("schema"), "gonio/glass/1");
  const json& gloss = read.at("glasses").at(0).at("gloss_gu");
  EXPECT_TRUE(is_close(gloss.at("20"), 89.18, 0.0051));
  EXPECT_TRUE(is_close(gloss.at("60"), 93.57, 0.0051));
  EXPECT_TRUE(is_close(gloss.at("85"), 99.43, 0.0051));
  EXPECT_THAT(output_of({"glass"}), HasSubstr(" 1.567      100.00      100.00      100.00\n"));
  EXPECT_EQ(lines_of(output_of({"glass", "--format", "csv"})).front(), "n,20,60,85");
}

TEST(RegistersProgram, WritesTheMapInEachFormat) {
  const std::map<std::string, std::string> files{{"page", "registers.md"},
                                                 {"csv", "registers.csv"},
                                                 {"openmodbus", "openmodbus.yaml"},
                                                 {"telegraf", "telegraf.toml"},
                                                 {"home_assistant", "home_assistant.yaml"}};
  for (const auto& [format, file] : files) {
    EXPECT_EQ(output_of({"registers", "--format", format}),
              test::contents(test::source_tree / "reports/registers" / file));
  }
  EXPECT_EQ(output_of({"registers"}), output_of({"registers", "--format", "page"}));
}

}  // namespace
}  // namespace gonio

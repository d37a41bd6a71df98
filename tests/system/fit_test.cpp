#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using test::contents;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

TEST(Fit, WritesASampleThatCanBeMeasured) {
  const Program program;
  const std::string data = (test::source_tree / "fixtures/measured/copper_simulated.csv").string();
  const std::string index = (test::source_tree / "fixtures/nk/main/Cu/Johnson.yml").string();
  const Outcome outcome = program.run({"fit", data, "--refractive-index", index, "--format", "json",
                                       "--write-sample", "copper.yaml", "--report", "page"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\"schema\": \"gonio/fit/1\""));
  EXPECT_THAT(contents(program.folder() / "page/fit.html"), HasSubstr("<svg"));
  EXPECT_THAT(contents(program.folder() / "page/fit.csv"), HasSubstr("cook_torrance,60,550,"));
  const Outcome measured =
      program.run({"measure", "--sample", "copper.yaml", "--standard", "iso_2813/2014"});
  EXPECT_EQ(measured.status, 0) << measured.err;
  EXPECT_THAT(measured.out, HasSubstr("fitted_cook_torrance"));
}

TEST(Fit, TakesAMeasuredBrdf) {
  const Outcome outcome =
      Program().run({"fit", (test::source_tree / "fixtures/brdf/satin_rosaline_rgb.bsdf").string(),
                     "--model", "ggx", "--format", "json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\"alpha\""));
}

/// What a scan of a sample records is fitted at its own positions: the sample is found again.
TEST(Fit, FindsTheSlopeOfAScannedSample) {
  const Program program;
  const Outcome scan =
      program.run({"scan", "--sample", "copper_polished", "--output", "scan.astm", "--as", "astm"});
  ASSERT_EQ(scan.status, 0) << scan.err;
  const std::string index = (test::source_tree / "fixtures/nk/main/Cu/Johnson.yml").string();
  const Outcome outcome =
      program.run({"fit", "scan.astm", "--refractive-index", index, "--format", "json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto told = nlohmann::json::parse(outcome.out);
  constexpr double planted = 0.065;
  constexpr double of_apertures = 0.01;  // of 1 deg each: they widen the lobe a little
  EXPECT_NEAR(told["models"][0]["parameters"][0]["value"].get<double>(), planted,
              of_apertures * planted);
}

TEST(Fit, RefusesAGeometryThatTheInstrumentDoesNotHave) {
  const Program program;
  std::ofstream(program.folder() / "data.csv") << "wavelength_nm,45\n500,0.1\n510,0.1\n";
  const Outcome outcome = program.run({"fit", "data.csv"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("one of 20, 60, 85, found '45'"));
}

}  // namespace
}  // namespace gonio

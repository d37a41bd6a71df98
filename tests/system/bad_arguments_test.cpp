#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using test::Outcome;
using test::Program;
using testing::HasSubstr;
using testing::StartsWith;

/// Measures a glass with more arguments. @return  what stands on standard error.
std::string error_of(std::vector<std::string> arguments) {
  const Program program;
  (void)program.file("glass.yaml", test::glass_sample());
  arguments.insert(arguments.begin(), {"measure", "--sample", "glass.yaml"});
  const Outcome outcome = program.run(arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err, "");
  return outcome.err;
}

std::string error_of_sample(const std::string& sample) {
  const Outcome outcome = Program().run({"measure", "--sample", sample});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

// Samples.

TEST(BadSampleArgument, OfAnIdThatIsNotThereListsTheIds) {
  const std::string message = error_of_sample("nonexistent");
  EXPECT_THAT(message, StartsWith("nonexistent: expected a sample file, or one of the ids "));
  EXPECT_THAT(message, HasSubstr(" copper_polished, "));
  EXPECT_THAT(message, testing::EndsWith(", found nothing\n"));
}

TEST(BadSampleArgument, OfAMissingFile) {
  EXPECT_THAT(error_of_sample("missing/file.yaml"),
              StartsWith("missing/file.yaml: expected a sample file, or one of the ids "));
}

TEST(BadSampleArgument, OfAFolder) {
  const std::string message = error_of_sample("/");
  EXPECT_THAT(message, StartsWith("/: expected a sample file"));
  EXPECT_THAT(message, testing::EndsWith("found 'a folder'\n"));
}

TEST(BadSampleArgument, OfTheWrongKindOfFile) {
  const auto standard = test::source_tree / "standards/iso_2813/2014/standard.yaml";
  EXPECT_EQ(
      error_of_sample(standard.string()),
      standard.string() + ":1:9: schema: expected gonio/sample/1, found 'gonio/standard/1'\n");
}

TEST(BadSampleArgument, OfTwoSamplesOfWhichOneIsBadMeasuresNothing) {
  EXPECT_THAT(error_of({"--sample", "nonexistent"}), StartsWith("nonexistent: expected"));
}

// Options of measure.

TEST(BadOption, Format) { EXPECT_THAT(error_of({"--format", "xml"}), HasSubstr("--format")); }

TEST(BadOption, Tolerance) {
  for (const char* value : {"0", "-1", "1e9", "small", "nan", "inf", ""}) {
    EXPECT_THAT(error_of({"--tolerance", value}),
                StartsWith("--tolerance: expected a number in [1e-12, 1000], found '"))
        << value;
  }
}

TEST(BadOption, Wavelengths) {
  for (const char* value :
       {"", "x", "380", "380:780", "380:780:0", "380:780:-5", "780:380:5", "380:780:7", "0:780:5",
        "nan:780:5", "380:inf:5", "380:780:5:5", "380:780:1e-9", "380 nm:780 nm:5 nm"}) {
    EXPECT_THAT(error_of({"--wavelengths", value}), HasSubstr("--wavelengths")) << value;
  }
}

TEST(BadOption, WavelengthsOutsideTheData) {
  EXPECT_THAT(error_of({"--wavelengths", "300:780:5"}),
              HasSubstr("expected values from 300 nm to 780 nm, found 'values from "));
}

TEST(BadOption, Tilt) {
  for (const char* value : {"3", "x", "3 nm", "nan deg", "46 deg", "-46 deg", ""}) {
    EXPECT_THAT(error_of({"--tilt", value}), HasSubstr("--tilt")) << value;
  }
}

TEST(BadOption, Patches) {
  for (const char* value : {"0", "-4", "2", "5", "4100", "x", "1e9"}) {
    EXPECT_THAT(error_of({"--integrator", "patches", "--patches", value}), HasSubstr("--patches"))
        << value;
  }
}

TEST(BadOption, PatchesForAnIntegratorThatHasNone) {
  EXPECT_THAT(error_of({"--patches", "5"}), HasSubstr("--patches"));
}

TEST(BadOption, Integrator) {
  EXPECT_THAT(error_of({"--integrator", "guess"}), HasSubstr("--integrator"));
}

TEST(BadOption, Geometry) {
  EXPECT_THAT(error_of({"--geometry", "45"}),
              HasSubstr("iso_2813/2014 has the geometries 20, 60, 85, not '45'"));
}

TEST(BadOption, GeometryOfUnknownSize) {
  EXPECT_THAT(error_of({"--standard", "tappi_t480/om_15"}),
              testing::ContainsRegex("standards/tappi_t480/om_15/standard.yaml:[0-9]+:[0-9]+: "
                                     "geometries\\[0\\]\\.source\\.[a-z_]+: expected a number, to "
                                     "measure in this geometry, found 'unknown'"));
}

TEST(BadOption, StandardAndInstrumentTogether) {
  const std::string message =
      error_of({"--standard", "iso_2813/2014", "--instrument", "triangle_gloss"});
  EXPECT_THAT(message, HasSubstr("--standard"));
  EXPECT_THAT(message, HasSubstr("--instrument"));
}

TEST(BadOption, StandardOrInstrumentThatIsNotThere) {
  EXPECT_THAT(error_of({"--standard", "iso_2813/2099"}),
              StartsWith("iso_2813/2099: expected a standard file, or one of the ids "));
  EXPECT_THAT(error_of({"--instrument", "nothing"}),
              StartsWith("nothing: expected an instrument file, or one of the ids "));
}

TEST(BadOption, ReferenceGlass) {
  EXPECT_THAT(error_of({"--reference-glass", "nothing.yml"}),
              StartsWith("nothing.yml: expected a file, found nothing"));
}

TEST(BadOption, ReferenceGlassForAScaleThatHasNone) {
  const auto glass = test::source_tree / "fixtures/nk/specs/ohara/optical/S-TIL26.yml";
  EXPECT_THAT(error_of({"--standard", "astm_c346/87", "--reference-glass", glass.string()}),
              HasSubstr("--reference-glass"));
}

TEST(BadOption, Data) {
  EXPECT_THAT(error_of({"--data", "nowhere"}),
              StartsWith("nowhere: expected a folder with standards and fixtures, found nothing"));
}

TEST(BadOption, Unknown) { EXPECT_THAT(error_of({"--colour"}), HasSubstr("--colour")); }

// The rest of the command line.

void expect_refused(const std::vector<std::string>& arguments, const std::string& naming) {
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(naming));
}

TEST(BadCommand, NoneAtAll) { expect_refused({}, "subcommand"); }
TEST(BadCommand, Unknown) {
  const std::string message =
      "expected one of the commands measure, colour, profile, list, glass, certify, qa, scan, "
      "acquire, calibrate, fit, validate, convert, serve, registers, read, trigger, watch, write, "
      "found '";
  expect_refused({"frobnicate"}, message + "frobnicate'");
  expect_refused({"frobnicate", "--help"}, message + "frobnicate'");
}
TEST(BadCommand, FitWithoutData) { expect_refused({"fit"}, "data"); }
TEST(BadCommand, FitOfAnUnknownModel) {
  expect_refused({"fit", "none.csv", "--model", "phong"}, "cook_torrance, ggx, ward");
}
TEST(BadCommand, MeasureWithoutASample) { expect_refused({"measure"}, "--sample"); }
TEST(BadCommand, RegistersInAnUnknownFormat) {
  expect_refused({"registers", "--format", "json"}, "--format");
}
TEST(BadCommand, ListOfNothing) { expect_refused({"list"}, "what"); }
TEST(BadCommand, ListOfTheUnknown) { expect_refused({"list", "paints"}, "paints"); }

TEST(BadCommand, GlassOfAnIndexThatIsNone) {
  for (const char* value : {"0.5", "11", "x", "nan", "-1.5"}) {
    expect_refused({"glass", "--index", value}, "--index");
  }
}

TEST(BadCommand, GlassOfAScaleWithoutOne) {
  expect_refused({"glass", "--standard", "astm_c346/87"}, "astm_c346/87 has no reference glass");
}

}  // namespace
}  // namespace gonio

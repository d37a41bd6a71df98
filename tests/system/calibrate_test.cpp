#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

// `gonio acquire` and `gonio calibrate`: exit status, output, and the files that they leave.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contents;
using test::Outcome;
using test::Program;
using test::with;
using testing::HasSubstr;

const std::vector<std::string> acquire{"acquire", "black_glass_spectra"};
const std::vector<std::string> calibrate{
    "calibrate", "black_glass_spectra", "--sample", "black_glass_n1567", "--method", "fit"};

TEST(Acquire, WritesSpectraThatCalibrateReads) {
  const Program program;
  const Outcome acquired = program.run(with(acquire, {"--output", "spectra.csv"}));
  EXPECT_EQ(acquired.status, 0) << acquired.err;
  EXPECT_EQ(acquired.err, "");
  EXPECT_THAT(acquired.out, HasSubstr("85: 2 pixels of the detector saturated and left out"));
  EXPECT_THAT(contents(program.folder() / "spectra.csv"),
              testing::StartsWith("wavelength_nm,20,u_20,60,u_60,85,u_85\n435,"));
  std::vector<std::string> from_csv = with(calibrate, {"--format", "json"});
  const json direct = json::parse(program.run(from_csv).out);
  from_csv[1] = "spectra.csv";
  const json by_file = json::parse(program.run(from_csv).out);
  EXPECT_EQ(direct.at("fit").at("parameters"), by_file.at("fit").at("parameters"));
}

TEST(Acquire, HasTheKeysThatItsSchemaPromises) {
  const Outcome outcome = Program().run(with(acquire, {"--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("schema"), "gonio/acquired_spectra/1");
  for (const json& spectrum : result.at("spectra")) {
    EXPECT_EQ(spectrum.at("reflectance").size(), spectrum.at("u").size());
  }
}

TEST(Calibrate, FindsThePlantedAngles) {
  const Program program;
  const Outcome outcome = program.run(with(
      calibrate, {"--format", "json", "--write-instrument", "found.yaml", "--report", "report"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("schema"), "gonio/setup_calibration/1");
  EXPECT_EQ(result.at("grid"), nullptr);
  const double planted[] = {20.10, 60.25, 84.90};
  for (std::size_t i = 0; i < 3; ++i) {
    const json& parameter = result.at("fit").at("parameters").at(i);
    EXPECT_LE(parameter.at("interval_95").at(0).get<double>(), planted[i]);
    EXPECT_GE(parameter.at("interval_95").at(1).get<double>(), planted[i]);
  }
  for (const char* file : {"calibration.html", "calibration.json", "calibration.txt"}) {
    EXPECT_TRUE(fs::is_regular_file(program.folder() / "report" / file)) << file;
  }
  EXPECT_THAT(contents(program.folder() / "report/calibration.html"),
              HasSubstr("measured and simulated reflectance"));
  const Outcome measured =
      program.run({"measure", "--instrument", "found.yaml", "--sample", "black_glass_n1567"});
  EXPECT_EQ(measured.status, 0) << measured.err;
}

TEST(Calibrate, TriesThePlanOfThePaper) {
  const Outcome outcome = Program().run(
      {"calibrate", "black_glass_spectra", "--plan", "paper_7_1", "--method", "grid"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("196608 patches"));
  EXPECT_THAT(outcome.out, HasSubstr("the paper's finding holds for these spectra"));
}

void expect_refused(const std::vector<std::string>& arguments, const std::string& naming) {
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(naming));
}

TEST(Calibrate, RefusesWhatItCannotDo) {
  expect_refused({"acquire"}, "acquisition");
  expect_refused({"acquire", "none"}, "found nothing");
  expect_refused({"calibrate"}, "expected spectra, found none");
  expect_refused({"calibrate", "missing.csv", "--sample", "black_glass_n1567"}, "missing.csv");
  expect_refused({"calibrate", "black_glass_spectra"}, "--sample: expected one sample");
  expect_refused(with(calibrate, {"--free", "lamp"}), "found 'lamp'");
  expect_refused(with(calibrate, {"--free", "theta_i:45"}), "found '45'");
  expect_refused(with(calibrate, {"--geometry", "45"}), "found '45'");
  expect_refused(with(calibrate, {"--plan", "none"}), "found nothing");
  expect_refused(with(calibrate, {"--relative-to", "glass"}), "--relative-to");
}

TEST(Calibrate, SaysThatADiskIsFull) {
  const Outcome outcome = Program().run(with(calibrate, {"--write-instrument", "/dev/full/x"}));
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace gonio

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

// What `gonio measure --report` leaves in its folder.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contents;
using test::Outcome;
using test::Program;
using test::with;
using testing::HasSubstr;

const std::vector<std::string> measure_paint{"measure", "--sample", "black_semi_gloss",
                                             "--geometry", "60"};

TEST(MeasureReport, IsAPageAndTheSameJsonAndCsvAsArePrinted) {
  const Program program;
  const Outcome outcome = program.run(with(measure_paint, {"--report", "a/b", "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const fs::path folder = program.folder() / "a/b";
  EXPECT_EQ(contents(folder / "measurement.json"), outcome.out);
  EXPECT_EQ(contents(folder / "measurement.csv"),
            program.run(with(measure_paint, {"--format", "csv"})).out);
  const std::string page = contents(folder / "measurement.html");
  EXPECT_THAT(page, HasSubstr("<h1>Gloss of black_semi_gloss</h1>"));
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3);
}

TEST(MeasureReport, ShowsTheFootprintOfASampleWithALobeThatIsNotTilted) {
  const Program program;
  const std::string heading = "What the receptors see";
  const fs::path page = program.folder() / "measurement.html";
  ASSERT_EQ(program.run(with(measure_paint, {"--report", "."})).status, 0);
  EXPECT_THAT(contents(page), HasSubstr(heading));
  ASSERT_EQ(program.run(with(measure_paint, {"--report", ".", "--tilt", "0.1 deg"})).status, 0);
  EXPECT_THAT(contents(page), testing::Not(HasSubstr(heading)));
}

TEST(MeasureReport, WhereAFileStandsIsTheEnvironmentsFault) {
  const Program program;
  (void)program.file("taken", "precious");
  const Outcome outcome = program.run(with(measure_paint, {"--report", "taken"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("taken"));
  EXPECT_EQ(contents(program.folder() / "taken"), "precious");
}

TEST(MeasureReport, WithoutGnuplotIsTheEnvironmentsFaultAndLeavesNothing) {
  Program program;
  program.set("PATH", program.folder().string());
  const Outcome outcome = program.run(with(measure_paint, {"--report", "report"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("gnuplot"));
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST(MeasureReport, OfABadSampleLeavesNothing) {
  const Program program;
  EXPECT_EQ(program.run({"measure", "--sample", "no_such_sample", "--report", "report"}).status, 2);
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST(MeasureReport, RunsNothingThatASampleFileSays) {
  const Program program;
  const fs::path sample = program.file(
      "sample.yaml",
      "schema: gonio/sample/1\nid: mine\ntitle: \"`touch trace` $(touch trace) <script>\"\n"
      "surface: {model: ggx, alpha: 0.1, refractive_index: 1.5}\n");
  const Outcome outcome = program.run({"measure", "--sample", "sample.yaml", "--report", "report"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(program.folder() / "trace"));
  EXPECT_THAT(contents(program.folder() / "report/measurement.html"),
              HasSubstr("`touch trace` $(touch trace) &lt;script&gt;"));
}

}  // namespace
}  // namespace gonio

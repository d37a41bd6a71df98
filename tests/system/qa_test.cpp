#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "emulator/store/store.hpp"
#include "tests/system/program.hpp"
#include "tests/system/qa_batches.hpp"

namespace gonio {

namespace {

using nlohmann::json;
using test::batch_text;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

/// Without the studies of risks, which take most of the time.
const std::vector<std::string> quick{"--risk-lots", "0"};

json result_of(const Program& program, const std::vector<std::string>& arguments) {
  const Outcome outcome =
      program.run(test::with({"qa"}, test::with(arguments, {"--format", "json"})));
  EXPECT_EQ(outcome.err, "");
  return json::parse(outcome.out);
}

}  // namespace

TEST(Qa, PrintsWhatItsContractSays) {
  const Program program;
  const json result = result_of(program, {"coil_coating_60"});
  EXPECT_EQ(result.at("schema"), "gonio/qa/1");
  EXPECT_EQ(result.at("verdict"), "pass");
  EXPECT_EQ(result.at("panels"), 40);
  EXPECT_GE(result.at("readings"), 40 * 3);
  for (const char* number : {"mean_gu", "sd_gu", "cpk", "producer_risk", "consumer_risk"}) {
    EXPECT_TRUE(result.at(number).is_number()) << number;
  }
  EXPECT_EQ(result.at("store"), "sqlite:qa.db");
  EXPECT_EQ(result.at("run"), 1);
  EXPECT_TRUE(std::filesystem::is_regular_file(program.folder() / "qa.db"));
}

TEST(Qa, ShippedBatchesComeOutAsTheyAreMeantTo) {
  const Program program;
  const auto verdict = [&](const std::string& batch) {
    const Outcome outcome = program.run(test::with({"qa", batch, "--format", "json"}, quick));
    const std::string said = json::parse(outcome.out).at("verdict");
    EXPECT_EQ(outcome.status, said == "pass" ? 0 : 1) << batch;
    return said;
  };
  EXPECT_EQ(verdict("coil_coating_60"), "pass");
  EXPECT_EQ(verdict("coil_coating_60_out"), "fail");
  EXPECT_EQ(verdict("coil_coating_60_guard_band"), "inconclusive");
  EXPECT_EQ(verdict("automotive_clearcoat_20"), "pass");
  EXPECT_EQ(verdict("wall_paint_85"), "pass");
}

// The same with the rule simple: nothing but the guard band was in doubt.
TEST(Qa, OnlyTheGuardBandMakesItInconclusive) {
  const Program program;
  std::string text =
      test::contents(test::source_tree / "fixtures/batches/coil_coating_60_guard_band.yaml");
  const std::size_t rule = text.find("rule: guarded");
  ASSERT_NE(rule, std::string::npos);
  text.replace(rule, std::string("rule: guarded").size(), "rule: simple");
  const auto file = program.file("simple.yaml", text);
  EXPECT_EQ(program.run(test::with({"qa", file.string()}, quick)).status, 0);
}

TEST(Qa, MeansAreThoseThatMeasuringGives) {
  const Program program;
  const auto file = program.file("batch.yaml", batch_text({.spread = ""}));
  const json result = result_of(program, test::with({file.string()}, quick));
  const json measured = json::parse(
      program
          .run({"measure", "--sample", "black_semi_gloss", "--geometry", "60", "--format", "json"})
          .out);
  constexpr double polynomial_error_gu = 1e-3;  // of optics that are read once
  EXPECT_NEAR(result.at("mean_gu"), measured.at("geometries").at(0).at("gloss_gu"),
              polynomial_error_gu);
  EXPECT_NEAR(result.at("sd_gu"), 0.0, 1e-9);
}

TEST(Qa, DoesNotDependOnTheNumberOfProcessors) {
  const Program all;
  const Program one("/usr/bin/taskset");
  const std::vector<std::string> arguments{"qa",  "coil_coating_60", "--risk-lots",
                                           "200", "--format",        "json"};
  const auto without_times = [](const std::string& text) {
    json result = json::parse(text);
    result.at("provenance").erase("started");
    return result;
  };
  const Outcome with_all = all.run(arguments);
  const Outcome with_one = one.run(test::with({"-c", "0", std::string(GONIO_PROGRAM)}, arguments));
  EXPECT_EQ(without_times(with_all.out), without_times(with_one.out));
}

TEST(Qa, WritesAReportOfFourFiles) {
  const Program program;
  ASSERT_EQ(program.run(test::with({"qa", "coil_coating_60", "--report", "report"}, quick)).status,
            0);
  const auto folder = program.folder() / "report";
  EXPECT_THAT(test::contents(folder / "qa.html"), HasSubstr("Verdict"));
  EXPECT_EQ(json::parse(test::contents(folder / "qa.json")).at("run"), 1);
  EXPECT_THAT(test::contents(folder / "qa.txt"), HasSubstr("pass"));
  EXPECT_THAT(test::contents(folder / "readings.csv"), HasSubstr("triangle_gloss"));
}

TEST(Qa, TellsHistoryExportsAndVerifies) {
  const Program program;
  for (const char* seed : {"1", "2", "3"}) {
    ASSERT_EQ(program.run(test::with({"qa", "coil_coating_60", "--seed", seed}, quick)).status, 0);
  }
  const json history = json::parse(program.run({"qa", "history", "--format", "json"}).out);
  EXPECT_EQ(history.at("schema"), "gonio/qa_history/1");
  EXPECT_THAT(program.run({"qa", "history"}).out, HasSubstr("coil_coating_60"));
  const std::string csv = program.run({"qa", "export", "2"}).out;
  EXPECT_EQ(program.run({"qa", "export", "2", "--output", "two.csv"}).status, 0);
  EXPECT_EQ(test::contents(program.folder() / "two.csv"), csv);
  EXPECT_EQ(json::parse(program.run({"qa", "export", "2", "--format", "json"}).out).at("schema"),
            "gonio/qa_readings/1");
  const Outcome verified = program.run({"qa", "verify", "2"});
  EXPECT_EQ(verified.status, 0);
  EXPECT_EQ(verified.out, "run 2: 50 of 50 panels are the same to the last bit\n");
}

TEST(Qa, JudgesMeasuredReadings) {
  const Program program;
  const Outcome outcome =
      program.run({"qa", "coil_coating_60_measured", "--readings",
                   (test::source_tree / "fixtures/measured/coil_coating_60_invented.csv").string(),
                   "--format", "json"});
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("panels"), 12);
  EXPECT_EQ(result.at("readings"), 36);
  EXPECT_TRUE(result.at("cpk").is_number());
  EXPECT_TRUE(result.at("consumer_risk").is_number());
}

// Two single readings of a device that somebody built: 21.23 and 20.90, and an average.
TEST(Qa, ReadsTheExportOfARealInstrument) {
  const Program program;
  const Outcome outcome =
      program.run({"qa", "bleskomer_export", "--readings",
                   (test::source_tree / "fixtures/measured/bleskomer_export.txt").string(),
                   "--format", "json"});
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("panels"), 2);
  EXPECT_DOUBLE_EQ(result.at("mean_gu"), (21.23 + 20.90) / 2.0);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(result.at("sd_gu"), (21.23 - 20.90) / std::sqrt(2.0), rounding);
}

TEST(BadQa, ABadBatchStoresNothing) {
  const Program program;
  const auto file = program.file("batch.yaml", batch_text({.spread = "{roughness: {lots: -0.1}}"}));
  const Outcome outcome = program.run({"qa", file.string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::MatchesRegex(
                               ".*batch.yaml:7:[0-9]+: product.spread.roughness.lots: expected a "
                               "number >= 0, found '-0.1'\n"));
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "qa.db"));
}

TEST(BadQa, BadReadingsStoreNothing) {
  const Program program;
  const auto batch = program.file("batch.yaml", batch_text({}));
  const auto readings = program.file("readings.csv", "panel,60\na,52.1\na,52.3\na,dull\n");
  const Outcome outcome = program.run({"qa", batch.string(), "--readings", readings.string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("readings.csv:4:3: "));
  EXPECT_THAT(outcome.err, HasSubstr("found 'dull'"));
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "qa.db"));
}

TEST(BadQa, UnknownRunStoreOrBatch) {
  const Program program;
  EXPECT_THAT(program.run({"qa", "history"}).err,
              HasSubstr("--store: expected a store, found nothing at qa.db"));
  EXPECT_EQ(program.run({"qa", "history"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "qa.db"));
  ASSERT_EQ(program.run(test::with({"qa", "coil_coating_60"}, quick)).status, 0);
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"qa", "export", "7"},
                                             {"qa", "verify", "7"},
                                             {"qa", "history", "--batch", "nobody"},
                                             {"qa", "nobody"},
                                             {"qa"},
                                             {"qa", "coil_coating_60", "--store", "mysql:qa"},
                                             {"qa", "coil_coating_60", "--resume"}}) {
    const Outcome outcome = program.run(arguments);
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_NE(outcome.err, "");
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(BadQa, AFileThatIsNoStore) {
  const Program program;
  const auto file = program.file("qa.db", "This is no database, but a text of some length.\n");
  const Outcome outcome = program.run(test::with({"qa", "coil_coating_60"}, quick));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("sqlite:qa.db"));
  EXPECT_EQ(test::contents(file), "This is no database, but a text of some length.\n");
}

TEST(BadQa, AFullDiskUnderStandardOutput) {
  const Program program;
  ASSERT_EQ(program.run(test::with({"qa", "coil_coating_60"}, quick)).status, 0);
  const int full = open("/dev/full", O_WRONLY);
  EXPECT_EQ(Program::wait(program.start({"qa", "export", "1"}, full)), 3);
  close(full);
}

}  // namespace gonio

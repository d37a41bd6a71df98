#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

// `gonio certify`: exit status, output, and the files that it leaves.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contents;
using test::Outcome;
using test::Program;
using test::with;
using testing::HasSubstr;
using testing::StartsWith;

/// The least work: one geometry and few trials.
const std::vector<std::string> certify_briefly{"certify", "triangle_gloss", "--geometry",
                                               "20",      "--trials",       "10000"};

/// The shipped instrument with one angle beyond its limit, or close to it.
fs::path instrument_at(const Program& program, const std::string& theta_i) {
  std::string text = contents(test::source_tree / "fixtures/instruments/triangle_gloss.yaml");
  const auto replace = [&](const std::string& old, const std::string& by) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
      text.replace(at, old.size(), by);
      at += by.size();
    }
  };
  replace("theta_i: 19.97 deg", "theta_i: " + theta_i);
  replace("../", (test::source_tree / "fixtures").string() + "/");
  return program.file("instrument.yaml", text);
}

std::vector<std::string> certify_file(const fs::path& instrument) {
  std::vector<std::string> arguments = certify_briefly;
  arguments[1] = instrument.string();
  return arguments;
}

TEST(Certify, HasTheKeysThatItsSchemaPromises) {
  const Outcome outcome = Program().run(with(certify_briefly, {"--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const json certificate = json::parse(outcome.out);
  EXPECT_EQ(certificate.at("schema"), "gonio/certificate/1");
  EXPECT_EQ(certificate.at("verdict"), "pass");
  const json& limit = certificate.at("limits").at(0);
  for (const char* key :
       {"clause", "geometry", "quantity", "nominal", "tolerance", "as_built", "verdict"}) {
    EXPECT_TRUE(limit.contains(key)) << key;
  }
  ASSERT_GE(certificate.at("samples").size(), 12u);
  for (const json& sample : certificate.at("samples")) {
    EXPECT_EQ(sample.at("geometry"), "20");
    EXPECT_GT(sample.at("U_gu").get<double>(), sample.at("u_gu").get<double>());
    EXPECT_GE(sample.at("k").get<double>(), 1.9);
    for (const json& line : sample.at("budget")) {
      for (const char* key : {"component", "u", "sensitivity", "contribution_gu"}) {
        EXPECT_TRUE(line.contains(key)) << key;
      }
    }
  }
}

TEST(Certify, ExitsByTheVerdict) {
  const Program program;
  EXPECT_EQ(program.run(certify_file(instrument_at(program, "19.97 deg"))).status, 0);
  const Outcome beyond = program.run(certify_file(instrument_at(program, "20.2 deg")));
  EXPECT_EQ(beyond.status, 1) << beyond.err;
  EXPECT_THAT(beyond.out, StartsWith("fail: At least one limit that counts is not met: theta_i"));
  const Outcome close = program.run(certify_file(instrument_at(program, "20.095 deg")));
  EXPECT_EQ(close.status, 1) << close.err;
  EXPECT_THAT(close.out, StartsWith("inconclusive: "));
}

TEST(Certify, DecidesAsAsked) {
  const Program program;
  const auto close = certify_file(instrument_at(program, "20.095 deg"));
  EXPECT_THAT(program.run(with(close, {"--decision", "simple"})).out, StartsWith("pass: "));
  EXPECT_THAT(program.run(with(close, {"--guard-band", "0.4"})).out, StartsWith("pass: "));
}

TEST(Certify, IsTheSameForTheSameSeed) {
  const auto json_of = [](const std::string& seed) {
    return Program().run(with(certify_briefly, {"--seed", seed, "--format", "json"})).out;
  };
  const std::string once = json_of("7");
  EXPECT_EQ(json_of("7"), once);
  EXPECT_NE(json_of("8"), once);
}

TEST(Certify, TakesSamplesBesidesTheLadder) {
  const Outcome outcome =
      Program().run(with(certify_briefly, {"--sample", "black_semi_gloss", "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out).at("samples").back().at("id"), "black_semi_gloss");
}

TEST(Certify, TakesItsArgumentsInAnyOrder) {
  const Program program;
  EXPECT_EQ(program.run({"certify", "--geometry", "20", "--trials", "10000", "triangle_gloss"}).out,
            program.run(certify_briefly).out);
}

TEST(Certify, TellsTheSetUpFromReadings) {
  const Program program;
  (void)program.file("readings.csv",
                     "sample,geometry,gloss_gu\nblack_semi_gloss,20,30\nglass_n1500,20,83\n");
  const Outcome outcome =
      program.run(with(certify_briefly, {"--readings", "readings.csv", "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json estimates = json::parse(outcome.out).at("estimates");
  ASSERT_EQ(estimates.size(), 1u);
  EXPECT_EQ(estimates.at(0).at("geometry"), "20");
  EXPECT_EQ(estimates.at(0).at("readings").size(), 2u);
}

TEST(Certify, RefusesReadingsOfTilesThatAreNotThere) {
  const Program program;
  (void)program.file("readings.csv", "sample,geometry,gloss_gu\nnonexistent,20,30\n");
  const Outcome outcome = program.run(with(certify_briefly, {"--readings", "readings.csv"}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, StartsWith("readings.csv:2:"));
  EXPECT_THAT(outcome.err, HasSubstr("found 'nonexistent'"));
}

TEST(Certify, RefusesWhatItCannotCertify) {
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& naming) {
    const Outcome outcome = Program().run(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(naming));
  };
  refused({"certify"}, "instrument");
  refused({"certify", "nothing"}, "nothing: expected an instrument file, or one of the ids ");
  refused(with(certify_briefly, {"--standard", "iso_2813/2099"}), "iso_2813/2099: expected");
  refused(with(certify_briefly, {"--standard", "modbus/v1_1b3"}), "measures nothing");
  refused({"certify", "triangle_gloss", "--geometry", "45"}, "45");
  refused(with(certify_briefly, {"--guard-band", "-1"}), "--guard-band");
  refused(with(certify_briefly, {"--guard-band", "nan"}), "--guard-band");
  refused({"certify", "triangle_gloss", "--trials", "0"}, "--trials");
  refused(with(certify_briefly, {"--seed", "-1"}), "--seed");
  refused(with(certify_briefly, {"--prior-tolerances", "0"}), "--prior-tolerances");
  refused(with(certify_briefly, {"--decision", "perhaps"}), "--decision");
  refused(with(certify_briefly, {"--format", "csv"}), "--format");
  refused(with(certify_briefly, {"--laboratory", "nowhere.yaml"}), "nowhere.yaml: expected a file");
}

TEST(CertifyReport, IsAPageAndTheSameJsonAsIsPrinted) {
  Program program;
  program.set("SOURCE_DATE_EPOCH", "1700000000");
  const std::string laboratory =
      (test::source_tree / "fixtures/laboratories/example.yaml").string();
  const Outcome outcome = program.run(
      with(certify_briefly, {"--report", "a/b", "--laboratory", laboratory, "--format", "json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const fs::path folder = program.folder() / "a/b";
  EXPECT_EQ(contents(folder / "certificate.json"), outcome.out);
  EXPECT_EQ(json::parse(outcome.out).at("date"), "2023-11-14");
  EXPECT_THAT(contents(folder / "certificate.txt"), StartsWith("pass: "));
  const std::string page = contents(folder / "certificate.html");
  EXPECT_THAT(page, HasSubstr("EGL-2026-0042"));
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3);
}

TEST(CertifyPdf, IsPrintedByChromium) {
  const Program program;
  const Outcome outcome = program.run(with(certify_briefly, {"--pdf", "certificate.pdf"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(contents(program.folder() / "certificate.pdf"), StartsWith("%PDF"));
  EXPECT_EQ(std::distance(fs::directory_iterator(program.folder()), fs::directory_iterator()), 1);
}

TEST(CertifyPdf, WithoutChromiumIsTheEnvironmentsFaultAndLeavesNothing) {
  Program program;
  program.set("PATH", program.folder().string());
  const Outcome outcome =
      program.run(with(certify_briefly, {"--pdf", "certificate.pdf", "--report", "report"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              HasSubstr("none of chromium, chromium-browser, google-chrome is installed"));
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST(CertifyReport, ThatIsInterruptedLeavesNothing) {
  // Interrupted while it prints, when all is made and nothing is written yet.
  const test::TemporaryFolder tools;
  const fs::path browser = tools.file("chromium", "#!/bin/sh\nkill -INT $PPID\n");
  fs::permissions(browser, fs::perms::owner_all);
  Program program;
  program.set("PATH", tools.path().string() + ":/usr/bin:/bin");
  program.set("TMPDIR", tools.path().string());
  const fs::path older = program.file("certificate.pdf", "precious");
  const Outcome outcome =
      program.run(with(certify_briefly, {"--report", "report", "--pdf", "certificate.pdf"}));
  EXPECT_EQ(outcome.status, 128 + SIGINT);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(contents(older), "precious");
  EXPECT_FALSE(fs::exists(program.folder() / "report"));
}

}  // namespace
}  // namespace gonio

// gonio-conformance as its user sees it: verdicts, exit status, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/serve_process.hpp"

namespace gonio {
namespace {

using nlohmann::json;
using test::contents;
using test::Outcome;
using test::Program;
using test::quietly;
using test::ServeProcess;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

enum Status { conforms = 0, does_not_conform = 1, bad_input = 2, device_failed = 3 };

Program conformance() { return Program(GONIO_CONFORMANCE); }

/// The records of that kind in a report of JSON lines.
std::vector<json> records(const std::string& text, const std::string& kind) {
  std::vector<json> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    json record = json::parse(line);
    if (record.at("record") == kind) {
      found.push_back(std::move(record));
    }
  }
  return found;
}

/// Verdicts by clause.
std::map<std::string, std::string> verdicts(const Outcome& outcome) {
  std::map<std::string, std::string> found;
  for (const json& clause : records(outcome.out, "clause")) {
    found[clause.at("id")] = clause.at("verdict");
  }
  return found;
}

std::vector<std::string> failing_that_count(const Outcome& outcome) {
  std::vector<std::string> ids;
  for (const json& clause : records(outcome.out, "clause")) {
    if (clause.at("counts") && clause.at("verdict") == "fail") {
      ids.push_back(clause.at("id"));
    }
  }
  return ids;
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// triangle_gloss, with a piece of its file exchanged.
std::string triangle_with(const std::string& from, const std::string& to) {
  const std::string text = contents(test::source_tree / "fixtures/instruments/triangle_gloss.yaml");
  EXPECT_THAT(text, HasSubstr(from));
  return replaced_all(replaced_all(text, "../", (test::source_tree / "fixtures/").string()), from,
                      to);
}

class ConformanceTo : public testing::TestWithParam<const char*> {};

TEST_P(ConformanceTo, IsShownByTheNominalInstrument) {
  const Outcome outcome = conformance().run({GetParam()});
  EXPECT_EQ(outcome.status, conforms) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("pass: "));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_P(ConformanceTo, IsShownByTheShippedInstrument) {
  const Outcome outcome = conformance().run({GetParam(), "--device", "triangle_gloss"});
  EXPECT_EQ(outcome.status, conforms) << outcome.out << outcome.err;
}

TEST_P(ConformanceTo, FailsByTheIncidenceAloneIfThatIsOff) {
  const Program program = conformance();
  const struct {
    const char *as_built, *off, *clause;
  } copies[] = {{"theta_i: 19.97 deg", "theta_i: 20.2 deg", "geometry/incidence_20"},
                {"theta_i: 60.04 deg", "theta_i: 60.2 deg", "geometry/incidence_60"},
                {"theta_i: 84.96 deg", "theta_i: 84.8 deg", "geometry/incidence_85"}};
  for (const auto& copy : copies) {
    const auto file = program.file("off.yaml", triangle_with(copy.as_built, copy.off));
    const Outcome outcome =
        program.run({GetParam(), "--device", file.string(), "--format", "json"});
    EXPECT_EQ(outcome.status, does_not_conform) << outcome.err;
    EXPECT_THAT(failing_that_count(outcome), ElementsAre(copy.clause));
  }
}

// At 3600 times its speed eight hours of drift take eight seconds.
TEST_P(ConformanceTo, IsTheSameOverModbus) {
  const Outcome in_process =
      conformance().run({GetParam(), "--device", "triangle_gloss", "--format", "json"});
  const Program serving;
  const ServeProcess server(serving,
                            quietly({"triangle_gloss", "--tcp", "127.0.0.1:0", "--speed", "3600"}));
  const Outcome over_modbus =
      conformance().run({GetParam(), "--device", "modbus://" + server.tcp(), "--format", "json"});
  EXPECT_EQ(over_modbus.status, conforms) << over_modbus.err;
  const auto expected = verdicts(in_process);
  EXPECT_GT(expected.size(), 30U);
  EXPECT_EQ(verdicts(over_modbus), expected);
}

INSTANTIATE_TEST_SUITE_P(Of, ConformanceTo, testing::Values("iso_2813/2014", "astm_d523/14"),
                         [](const auto& test) {
                           return std::string(test.param).starts_with("iso") ? "iso_2813"
                                                                             : "astm_d523";
                         });

TEST(Conformance, OfAllStandardsIsShownByNominalInstruments) {
  const Outcome outcome = conformance().run({"all"});
  EXPECT_EQ(outcome.status, conforms) << outcome.out << outcome.err;
}

TEST(Conformance, OfADeviceThatFallsSilentIsAnErrorWithAReport) {
  const Program serving;
  // It is found and read, but a command is never answered.
  const ServeProcess server(serving, quietly({"triangle_gloss", "--tcp", "127.0.0.1:0", "--speed",
                                              "3600", "--fault", "{fault: no_reply, function: 16}",
                                              "--fault", "{fault: no_reply, function: 6}",
                                              "--fault", "{fault: no_reply, function: 5}"}));
  const Program program = conformance();
  const Outcome outcome =
      program.run({"iso_2813/2014", "--device", "modbus://" + server.tcp(), "--timeout", "100 ms",
                   "--format", "json", "--report", "out"});
  EXPECT_EQ(outcome.status, device_failed) << outcome.err;
  const auto found = verdicts(outcome);
  EXPECT_EQ(found.at("geometry/incidence_60"), "pass");
  EXPECT_EQ(found.at("calibration/check_standard"), "error");
  EXPECT_THAT(contents(program.folder() / "out/report.html"), HasSubstr("error"));
}

TEST(Conformance, OfADeviceThatIsNotThereFailsAtOnce) {
  const Outcome outcome = conformance().run({"iso_2813/2014", "--device", "modbus://127.0.0.1:1"});
  EXPECT_EQ(outcome.status, device_failed);
  EXPECT_THAT(outcome.err, HasSubstr("modbus://127.0.0.1:1"));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST(Conformance, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& words) {
    const Outcome outcome = conformance().run(arguments);
    EXPECT_EQ(outcome.status, bad_input) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_THAT(outcome.out, IsEmpty());
  };
  refused({"iso_2813/2015"}, "expected one of the ids all, ");
  refused({"iso_2813/2014/geometry/nothing"}, "found 'iso_2813/2014/geometry/nothing'");
  refused({""}, "expected one of the ids all, ");
  refused({}, "ID is required");
  refused({"modbus"}, "--device: expected a server, modbus://");
  refused({"iso_2813/2014", "--device", "no_such"}, "expected an instrument file");
  refused({"iso_2813/2014", "--device", "colorimeter_45_0"},
          "expected an instrument that measures gloss, found 'colorimeter_45_0'");
  refused({"iso_2813/2014", "--device", "modbus://"}, "modbus://");
  refused({"iso_2813/2014", "--decision", "mild"}, "--decision");
  refused({"iso_2813/2014", "--loud"}, "--loud");
}

TEST(Conformance, TellsThePlaceOfABrokenCase) {
  const Program program = conformance();
  namespace fs = std::filesystem;
  fs::copy(test::source_tree / "standards", program.folder() / "standards",
           fs::copy_options::recursive);
  fs::create_directory_symlink(test::source_tree / "fixtures", program.folder() / "fixtures");
  const fs::path cases = program.folder() / "standards/cases/incidence.yaml";
  const std::string text = contents(cases);
  std::ofstream(cases) << replaced_all(text, "verdict: fail", "verdict: bad");
  const Outcome outcome = program.run({"iso_2813/2014", "--data", program.folder().string()});
  EXPECT_EQ(outcome.status, bad_input);
  EXPECT_THAT(outcome.err, HasSubstr("incidence.yaml:"));
  EXPECT_THAT(outcome.err, HasSubstr(".verdict: expected one of pass, fail"));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST(Conformance, ListsCasesByClause) {
  const Outcome outcome = conformance().run({"iso_2813/2014/geometry/receptor_60", "--list"});
  EXPECT_EQ(outcome.status, conforms);
  EXPECT_THAT(outcome.out, StartsWith("iso_2813/2014/geometry/receptor_60/"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("receptor_20")));
}

TEST(Conformance, OfOneClauseSaysNothingOfOthers) {
  const Outcome outcome =
      conformance().run({"iso_2813/2014/geometry/receptor_60", "--format", "json"});
  EXPECT_EQ(outcome.status, conforms);
  EXPECT_EQ(verdicts(outcome),
            (std::map<std::string, std::string>{{"geometry/receptor_60", "pass"}}));
}

TEST(Conformance, UnderstandsGoogleTestsOptions) {
  const Program program = conformance();
  const Outcome listed = program.run({"iso_2813/2014", "--gtest_list_tests",
                                      "--gtest_filter=iso_2813/2014/geometry/incidence_20*"});
  EXPECT_EQ(listed.status, conforms);
  EXPECT_THAT(listed.out, HasSubstr("iso_2813/2014/geometry/incidence_20.\n"));
  const Outcome run = program.run({"iso_2813/2014", "--gtest_output=xml:tests.xml",
                                   "--gtest_filter=iso_2813/2014/geometry/incidence_20*"});
  EXPECT_EQ(run.status, conforms) << run.err;
  const std::string xml = contents(program.folder() / "tests.xml");
  EXPECT_THAT(xml, HasSubstr("standards/cases/incidence.yaml"));
  EXPECT_THAT(xml, HasSubstr(R"(<property name="verdict" value="pass")"));
}

TEST(Conformance, LeavesOutWhatAFilterLeavesOut) {
  const Outcome outcome = conformance().run(
      {"iso_2813/2014/geometry", "--format", "json", "--gtest_filter=*incidence_20*"});
  EXPECT_EQ(outcome.status, conforms);
  EXPECT_EQ(verdicts(outcome),
            (std::map<std::string, std::string>{{"geometry/incidence_20", "pass"}}));
}

TEST(Conformance, TellsOfItselfBeforeGoogleTest) {
  const Outcome help = conformance().run({"--help"});
  EXPECT_EQ(help.status, conforms);
  EXPECT_THAT(help.out, StartsWith("Judges a glossmeter"));
  EXPECT_THAT(help.out, HasSubstr("Example: gonio-conformance "));
  EXPECT_THAT(help.err, IsEmpty());
  const Outcome wrong = conformance().run({"iso_2813/2014", "--gtest_filtre=x"});
  EXPECT_EQ(wrong.status, bad_input);
  EXPECT_THAT(wrong.err, HasSubstr("--gtest_filtre=x"));
}

TEST(Conformance, WritesTheSameReportsAgain) {
  Program program = conformance();
  program.set("SOURCE_DATE_EPOCH", "1700000000");
  for (const char* folder : {"first", "second"}) {
    EXPECT_EQ(
        program.run({"iso_2813/2014", "--device", "triangle_gloss", "--report", folder}).status,
        conforms);
  }
  for (const char* name : {"report.html", "report.md"}) {
    const std::string first = contents(program.folder() / "first" / name);
    EXPECT_THAT(first, HasSubstr("2023-11-14"));
    EXPECT_EQ(first, contents(program.folder() / "second" / name)) << name;
  }
  EXPECT_THAT(contents(program.folder() / "first/junit.xml"), StartsWith("<?xml"));
  EXPECT_THAT(contents(program.folder() / "first/results.jsonl"), StartsWith("{\"schema\":"));
}

TEST(Conformance, LeavesNoReportsWhereItCannotWrite) {
  const Program program = conformance();
  (void)program.file("taken", "a file");
  const Outcome outcome = program.run({"iso_2813/2014", "--report", "taken"});
  EXPECT_EQ(outcome.status, device_failed);
  EXPECT_THAT(outcome.err, HasSubstr("taken"));
  EXPECT_EQ(contents(program.folder() / "taken"), "a file");
}

// A standard is data: none of the sources knows this one.
TEST(Conformance, ToAStandardTakesItsFilesOnly) {
  EXPECT_EQ(conformance().run({"gb_t_9754/2007"}).status, conforms);
  namespace fs = std::filesystem;
  for (const char* folder : {"emulator", "reports", "tests/conformance"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::source_tree / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".cpp" || extension == ".hpp" ||
          entry.path().filename() == "CMakeLists.txt") {
        EXPECT_THAT(contents(entry.path()), Not(HasSubstr("gb_t_9754"))) << entry.path();
      }
    }
  }
}

TEST(Conformance, CoverageOfTheReadmeIsThatOfTheFiles) {
  const Outcome outcome = conformance().run({"all", "--coverage"});
  EXPECT_EQ(outcome.status, conforms);
  EXPECT_THAT(contents(test::source_tree / "standards/README.md"),
              HasSubstr("<!-- coverage begin -->\n" + outcome.out + "<!-- coverage end -->"))
      << "write `gonio-conformance all --coverage` between the marks";
}

}  // namespace
}  // namespace gonio

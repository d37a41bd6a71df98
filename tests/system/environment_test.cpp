#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/system/program.hpp"

// Where the program writes, and where it finds its data.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

const std::vector<std::string> measure_glass{"measure", "--sample", "black_glass_n1567"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Output that cannot be written.

TEST(SpectrumFile, InAFolderThatIsNotThereIsTheEnvironmentsFault) {
  const Program program;
  const Outcome outcome = program.run(with(measure_glass, {"--spectrum", "no/spectrum.csv"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("no/spectrum.csv"));
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST(SpectrumFile, InAFolderWithoutPermissionLeavesNothingBehind) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may write everywhere";
  }
  const Program program;
  const fs::path locked = program.folder() / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = program.run(with(measure_glass, {"--spectrum", "locked/spectrum.csv"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(fs::is_empty(locked));
}

TEST(SpectrumFile, ThatIsAFolderLeavesNothingBehind) {
  const Program program;
  fs::create_directory(program.folder() / "folder");
  const Outcome outcome = program.run(with(measure_glass, {"--spectrum", "folder"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::distance(fs::directory_iterator(program.folder()), fs::directory_iterator()), 1);
}

TEST(SpectrumFile, ThatWasThereBeforeIsKeptWhenMeasuringFails) {
  const Program program;
  const fs::path file = program.file("spectrum.csv", "precious\n");
  const Outcome outcome =
      program.run(with(measure_glass, {"--geometry", "45", "--spectrum", "spectrum.csv"}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(test::contents(file), "precious\n");
}

TEST(StandardOutput, ThatIsFullIsTheEnvironmentsFault) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  EXPECT_EQ(Program::wait(Program().start(measure_glass, full)), 3);
  close(full);
}

/// A pipe whose reader takes a few bytes and leaves.
int status_with_reader_that_leaves(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  const Program program;
  const pid_t process = program.start(arguments, ends[1]);
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 1);
  close(ends[0]);
  return Program::wait(process);
}

TEST(StandardOutput, WhoseReaderLeavesEndsTheProgram) {
  const auto old = std::signal(SIGPIPE, SIG_DFL);  // the program inherits it
  const int status = status_with_reader_that_leaves(
      with(measure_glass, {"--format", "json", "--wavelengths", "380:780:0.02"}));
  EXPECT_EQ(status, 128 + SIGPIPE);
  std::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(status_with_reader_that_leaves(
                with(measure_glass, {"--format", "json", "--wavelengths", "380:780:0.02"})),
            3);
  std::signal(SIGPIPE, old);
}

// Data.

/// A folder of data in which one sample has another index.
fs::path make_data(const fs::path& folder, const std::string& index) {
  fs::create_directories(folder / "standards");
  fs::create_directories(folder / "fixtures/samples");
  std::ofstream(folder / "fixtures/samples/black_glass_n1567.yaml")
      << "schema: gonio/sample/1\nid: glass_" << index
      << "\ntitle: Glass\nsurface: {model: smooth, refractive_index: 1." << index << "}\n";
  return folder;
}

std::string sample_measured(const Program& program, const std::vector<std::string>& more = {}) {
  const Outcome outcome = program.run(with(with(measure_glass, {"--format", "json"}), more));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? json::parse(outcome.out).at("sample").get<std::string>() : "";
}

TEST(DataFolders, AreSearchedInTheirOrder) {
  Program program;
  EXPECT_EQ(sample_measured(program), "black_glass_n1567");
  program.set("GONIO_DATA", make_data(program.folder() / "set", "52").string());
  EXPECT_EQ(sample_measured(program), "glass_52");
  const std::string given = make_data(program.folder() / "given", "53").string();
  EXPECT_EQ(sample_measured(program, {"--data", given}), "glass_53");
}

TEST(DataFolders, HaveTheInstalledShareFolderBeforeTheSourceTree) {
  const test::TemporaryFolder prefix;
  fs::create_directory(prefix.path() / "bin");
  fs::copy_file(GONIO_PROGRAM, prefix.path() / "bin/gonio");
  fs::create_directories(prefix.path() / "share/gonio");
  for (const char* data : {"standards", "fixtures"}) {
    fs::copy(test::source_tree / data, prefix.path() / "share/gonio" / data,
             fs::copy_options::recursive);
  }
  Program installed(prefix.path() / "bin/gonio");
  const Outcome list = installed.run({"list", "samples", "--format", "csv"});
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_THAT(list.out, HasSubstr((prefix.path() / "share/gonio").string()));
  std::string cell(1, ',');
  cell += (test::source_tree / "fixtures").string();
  EXPECT_THAT(list.out, testing::Not(HasSubstr(cell)));
  EXPECT_EQ(sample_measured(installed), "black_glass_n1567");
  installed.set("GONIO_DATA", make_data(installed.folder() / "set", "52").string());
  EXPECT_EQ(sample_measured(installed), "glass_52");
}

TEST(DataFolders, ThatAreNoneSayWhatIsMissing) {
  const test::TemporaryFolder empty;
  fs::copy_file(GONIO_PROGRAM, empty.path() / "gonio");
  const Outcome outcome = Program(empty.path() / "gonio").run(measure_glass);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("expected"));
}

// A standard of one's own that borrows geometries.

std::string borrowing(const std::string& from) {
  std::string text = test::contents(test::source_tree / "standards/astm_d4039/09/standard.yaml");
  const auto replace_all = [&](const std::string& old, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += with.size()) {
      text.replace(at, old.size(), with);
    }
  };
  replace_all("../../../fixtures", (test::source_tree / "fixtures").string());
  replace_all("standard: astm_d523/14", "standard: " + from);
  return text;
}

TEST(UserStandard, MayBorrowGeometriesFromAStandardThatShips) {
  const Program program;
  (void)program.file("house.yaml", borrowing("astm_d523/14"));
  const Outcome outcome = program.run(with(measure_glass, {"--standard", "house.yaml"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(UserStandard, MayNotBorrowFromItself) {
  const Program program;
  fs::create_directories(program.folder() / "house/1");
  (void)program.file("house/1/standard.yaml", borrowing("house/1"));
  const Outcome outcome = program.run(with(measure_glass, {"--standard", "house/1/standard.yaml"}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::StartsWith("house/1/standard.yaml:"));
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace gonio

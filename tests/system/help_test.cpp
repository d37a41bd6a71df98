#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/serve_fixture.hpp"

namespace gonio {
namespace {

using test::Outcome;
using test::Program;

std::string help_of(std::vector<std::string> command) {
  command.emplace_back("--help");
  const Outcome outcome = Program().run(command);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

/// The command lines after "Example:", each as its words without `gonio`.
std::vector<std::vector<std::string>> examples_in(const std::string& help) {
  std::vector<std::vector<std::string>> examples;
  std::istringstream lines(help);
  bool among_examples = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) {
      words.push_back(word);
    }
    among_examples = line.starts_with("Example") || (among_examples && line.starts_with(" "));
    if (among_examples && words.size() > 1) {
      const std::size_t skipped = words.front().starts_with("Example") ? 2 : 1;
      EXPECT_EQ(words[skipped - 1], "gonio") << line;
      examples.emplace_back(words.begin() + std::ptrdiff_t(skipped), words.end());
    }
  }
  return examples;
}

const std::vector<std::vector<std::string>> commands{{},
                                                     {"measure"},
                                                     {"colour"},
                                                     {"profile"},
                                                     {"list"},
                                                     {"glass"},
                                                     {"certify"},
                                                     {"qa"},
                                                     {"qa", "history"},
                                                     {"qa", "export"},
                                                     {"qa", "verify"},
                                                     {"scan"},
                                                     {"acquire"},
                                                     {"calibrate"},
                                                     {"fit"},
                                                     {"validate"},
                                                     {"convert"},
                                                     {"registers"}};

/// Commands that need a device, or go on until they are told to end.
const std::vector<std::vector<std::string>> device_commands{
    {"read"}, {"trigger"}, {"watch"}, {"write"}};

TEST(Help, ShowsAnExampleForEachCommand) {
  auto all = commands;
  all.insert(all.end(), device_commands.begin(), device_commands.end());
  all.push_back({"serve"});
  for (const auto& command : all) {
    EXPECT_FALSE(examples_in(help_of(command)).empty()) << testing::PrintToString(command);
  }
}

TEST(Help, ShowsExamplesThatRun) {
  const Program program;
  (void)program.file("my_paint.yaml", test::glass_sample());
  std::filesystem::create_directory_symlink(test::source_tree / "fixtures",
                                            program.folder() / "fixtures");
  for (const auto& command : commands) {
    for (const auto& example : examples_in(help_of(command))) {
      const Outcome outcome = program.run(example);
      EXPECT_EQ(outcome.status, 0) << testing::PrintToString(example) << outcome.err;
      EXPECT_NE(outcome.out, "") << testing::PrintToString(example);
    }
  }
}

TEST(Help, ShowsExamplesThatRunWithADevice) {
  const test::ServedInstrument device({"--ideal", "--place", "tile", "--rtu", "pty"});
  for (const auto& command : device_commands) {
    for (auto example : examples_in(help_of(command))) {
      example[1] = example[1].starts_with("modbus-rtu:") ? device.rtu_url() : device.url();
      if (command.front() == "watch") {
        example.insert(example.end(), {"--count", "1"});
      }
      const Outcome outcome = Program().run(example);
      EXPECT_EQ(outcome.status, 0) << testing::PrintToString(example) << outcome.err;
    }
  }
}

TEST(Help, OfTheProgramNamesItsCommands) {
  const std::string help = help_of({});
  for (const char* command :
       {"  measure ", "  colour ", "  profile ", "  list ", "  glass ", "  certify ", "  qa ",
        "  scan ", "  acquire ", "  calibrate ", "  fit ", "  validate ", "  convert ", "  serve ",
        "  registers ", "  read ", "  trigger ", "  watch ", "  write "}) {
    EXPECT_THAT(help, testing::HasSubstr(command));
  }
  EXPECT_THAT(help, testing::HasSubstr("Exit status: 0 done"));
}

TEST(Version, IsPrinted) {
  const Outcome outcome = Program().run({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("gonio [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace gonio

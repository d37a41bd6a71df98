#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/serve_process.hpp"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using modbus::Table;
using nlohmann::json;
using test::Program;
using test::ServeProcess;
using test::triangle;
using testing::HasSubstr;

constexpr int snapshot = 114;  // registers

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::istringstream in(test::contents(file));
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// Lets a server answer requests and end. @return  its log.
fs::path log_of(const Program& program, int requests, const std::vector<std::string>& options) {
  fs::path file = program.folder() / "gonio.log";
  std::vector<std::string> arguments{triangle, "--tcp",      "127.0.0.1:0", "--format",
                                     "json",   "--log-file", file.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  ServeProcess server(program, arguments);
  ModbusClient client = server.connect();
  for (int i = 0; i < requests; ++i) {
    (void)client.read_registers(Table::input_registers, 0, snapshot);
  }
  EXPECT_EQ(server.end(), 0);
  return file;
}

TEST(ServeLog, AsJsonIsOneObjectALineWithEveryRequest) {
  const Program program;
  const fs::path file = log_of(program, 3, {"--log-format", "json", "--log-level", "trace"});
  int requests = 0;
  std::string last;
  for (const std::string& line : lines_of(file)) {
    const json entry = json::parse(line);
    EXPECT_THAT(entry.at("time").get<std::string>(),
                testing::MatchesRegex(
                    R"([0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}\.[0-9]{3}Z)"));
    last = entry.at("message");
    if (entry.at("level") == "trace") {
      ++requests;
      EXPECT_THAT(last, HasSubstr("unit 1, function 4: 04 00 00 00 72 -> 04 E4 "));
    }
  }
  EXPECT_EQ(requests, 3);
  EXPECT_THAT(last, HasSubstr("served 3 requests, 0 exceptions, 1 connections"));
  EXPECT_THAT(last, HasSubstr("by function code 4: 3"));
}

TEST(ServeLog, AsTextTellsTimeAndLevel) {
  const Program program;
  const std::vector<std::string> lines = lines_of(log_of(program, 1, {}));
  ASSERT_FALSE(lines.empty());
  for (const std::string& line : lines) {
    EXPECT_THAT(line, testing::MatchesRegex(R"([-0-9]{10} [:0-9]{8}\.[0-9]{3} info .*)"));
  }
  EXPECT_THAT(lines.back(), HasSubstr("served 1 requests"));
}

TEST(ServeLog, TellsNoRequestUnlessAsked) {
  const Program program;
  EXPECT_THAT(test::contents(log_of(program, 5, {"--log-level", "debug"})),
              testing::Not(HasSubstr("function 4")));
}

TEST(ServeLog, IsRotatedBySizeAndKeepsAsManyFilesAsAsked) {
  const Program program;
  constexpr int enough_for_three_files = 4000;
  constexpr std::uintmax_t mib = 1024 * 1024;
  const fs::path file = log_of(program, enough_for_three_files,
                               {"--log-level", "trace", "--log-size", "1", "--log-files", "1"});
  EXPECT_LE(fs::file_size(file), mib);
  EXPECT_LE(fs::file_size(program.folder() / "gonio.1.log"), mib);
  EXPECT_FALSE(fs::exists(program.folder() / "gonio.2.log"));
  EXPECT_THAT(lines_of(file).back(), HasSubstr("served 4000 requests"));
}

}  // namespace
}  // namespace gonio

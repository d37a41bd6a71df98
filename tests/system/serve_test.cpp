#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <string>

#include "tests/system/serve_process.hpp"

// How `gonio serve` begins and ends.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using modbus::Table;
using test::Outcome;
using test::Program;
using test::quietly;
using test::ServeProcess;
using test::triangle;
using testing::HasSubstr;
using testing::MatchesRegex;

constexpr std::uint16_t test_uint16 = 305, test_uint16_value = 54321;

// Its first line.

TEST(ServeAnnouncement, NamesTheTcpPortThatItGot) {
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  EXPECT_THAT(server.first_line(),
              MatchesRegex(R"(\{"schema":"gonio/listening/1","tcp":"127\.0\.0\.1:[1-9][0-9]*"\})"));
}

TEST(ServeAnnouncement, NamesThePseudoTerminalThatItMade) {
  const ServeProcess server(Program(), quietly({triangle, "--rtu", "pty"}));
  EXPECT_THAT(server.first_line(),
              MatchesRegex(R"(\{"schema":"gonio/listening/1","rtu":"/dev/pts/[0-9]+"\})"));
  EXPECT_TRUE(fs::is_character_file(server.rtu()));
}

TEST(ServeAnnouncement, NamesBothLines) {
  const ServeProcess server(Program(), quietly({triangle, "--rtu", "pty", "--tcp", "127.0.0.1:0"}));
  EXPECT_THAT(
      server.first_line(),
      MatchesRegex(
          R"(\{"schema":"gonio/listening/1","tcp":"127.0.0.1:[0-9]+","rtu":"/dev/pts/[0-9]+"\})"));
}

TEST(ServeAnnouncement, AsTextSaysHowToReadTheInstrument) {
  const ServeProcess server(Program(), {triangle, "--tcp", "127.0.0.1:0", "--log-level", "warn"});
  EXPECT_THAT(server.first_line(),
              MatchesRegex(R"(Modbus TCP on (127\.0\.0\.1:[0-9]+): gonio read modbus://.*)"));
}

TEST(ServeAnnouncement, PutsAnAddressOfIpVersion6InBrackets) {
  if (!fs::exists("/proc/net/if_inet6") || test::contents("/proc/net/if_inet6").empty()) {
    GTEST_SKIP() << "no IP version 6 here";
  }
  const ServeProcess server(Program(), quietly({triangle, "--tcp", "[::1]:0"}));
  EXPECT_THAT(server.tcp(), MatchesRegex(R"(\[::1\]:[1-9][0-9]*)"));
  EXPECT_EQ(server.connect().read_registers(Table::input_registers, test_uint16, 1).at(0),
            test_uint16_value);
}

// Its end.

/// So many requests that their replies do not fit into the buffers of a connection.
std::string many_questions() {
  constexpr std::string_view question("\0\1\0\0\0\6\1\4\0\0\0\x72", 12);
  std::string all;
  for (int i = 0; i < 5000; ++i) {
    all += question;
  }
  return all;
}

TEST(ServeEnd, OnASignalIsQuickAndCleanWhateverClientsDo) {
  for (const int signal : {SIGTERM, SIGINT}) {
    ServeProcess server(Program(), quietly({triangle, "--tcp", "127.0.0.1:0", "--rtu", "pty"}));
    ModbusClient client = server.connect();
    (void)client.read_registers(Table::input_registers, 0, 1);
    const test::Descriptor silent(test::connect_to(server.tcp()));
    const test::Descriptor halting(test::connect_to(server.tcp()));
    ASSERT_EQ(write(halting.number(), "\0\1\0\0", 4), 4);
    const test::Descriptor deaf(test::connect_to(server.tcp()));
    const std::string questions = many_questions();
    ASSERT_EQ(write(deaf.number(), questions.data(), questions.size()), questions.size());
    EXPECT_EQ(server.end(signal), 0);
  }
}

TEST(ServeEnd, TakesTheLinkToThePseudoTerminalAway) {
  const Program program;
  const fs::path link = program.folder() / "glossmeter";
  ServeProcess server(program, quietly({triangle, "--rtu", "pty", "--rtu-link", link.string()}));
  EXPECT_EQ(fs::read_symlink(link), server.rtu());
  EXPECT_EQ(server.end(), 0);
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(link)));
}

TEST(ServeEnd, LeavesItsPortToTheNextOneAtOnce) {
  // An address of its own, so that no other test can get the port in between.
  ServeProcess first(Program(), quietly({triangle, "--tcp", "127.28.13.2:0"}));
  const std::string place = first.tcp();
  ModbusClient client = first.connect();
  (void)client.read_registers(Table::input_registers, 0, 1);
  EXPECT_EQ(first.end(), 0);  // closes the connection, which then waits for late packets
  ServeProcess second(Program(), quietly({triangle, "--tcp", place}));
  EXPECT_EQ(second.tcp(), place);
  EXPECT_EQ(second.connect().read_registers(Table::input_registers, test_uint16, 1).at(0),
            test_uint16_value);
}

// What the environment can refuse.

Outcome outcome_of_serve(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = quietly(arguments);
  all.insert(all.begin(), "serve");
  return Program().run(all);
}

void expect_refused_by_environment(const std::vector<std::string>& arguments,
                                   const std::string& place) {
  const Outcome outcome = outcome_of_serve(arguments);
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(place));
}

TEST(ServeEnvironment, OfAPortInUseIsNamed) {
  const ServeProcess first(Program(), quietly({triangle, "--tcp", "127.0.0.1:0"}));
  expect_refused_by_environment({triangle, "--tcp", first.tcp()}, first.tcp());
}

TEST(ServeEnvironment, OfAnAddressOfAnotherMachineIsNamed) {
  expect_refused_by_environment({triangle, "--tcp", "192.0.2.1:0"}, "192.0.2.1:0");
}

TEST(ServeEnvironment, OfASerialLineThatIsNotThereIsNamed) {
  expect_refused_by_environment({triangle, "--rtu", "/dev/no_such_line"}, "/dev/no_such_line");
  expect_refused_by_environment({triangle, "--rtu", "/dev/null"}, "/dev/null");
}

TEST(ServeEnvironment, OfALogFileThatCannotBeWrittenIsNamed) {
  expect_refused_by_environment({triangle, "--tcp", "127.0.0.1:0", "--log-file", "/dev/null/log"},
                                "/dev/null/log");
}

TEST(ServeEnvironment, OfAStateFolderThatCannotBeMadeIsNamed) {
  expect_refused_by_environment({triangle, "--tcp", "127.0.0.1:0", "--state", "/dev/null/state"},
                                "/dev/null/state");
}

const std::vector<std::string> serve{"serve", triangle, "--tcp", "127.0.0.1:0"};

TEST(ServeEnvironment, OfAFullDiskForItsAnnouncementEndsIt) {
  const test::Descriptor full(open("/dev/full", O_WRONLY | O_CLOEXEC));
  EXPECT_EQ(Program::wait(Program().start(serve, full.number())), 3);
}

TEST(ServeEnvironment, OfNobodyWhoReadsItsAnnouncementEndsIt) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  close(ends[0]);
  const test::Descriptor out(ends[1]);
  const auto old = std::signal(SIGPIPE, SIG_IGN);  // the program inherits it
  EXPECT_EQ(Program::wait(Program().start(serve, out.number())), 3);
  std::signal(SIGPIPE, old);
}

}  // namespace
}  // namespace gonio

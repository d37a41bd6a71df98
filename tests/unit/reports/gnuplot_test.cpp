#include "reports/gnuplot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "tests/unit/message_of.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"

namespace gonio {
namespace {

using test::FakeGnuplot;
using testing::HasSubstr;

/// Whether this process has a child that nobody has waited for.
bool has_child_left() { return !(waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD); }

TEST(RunGnuplot, ReturnsWhatItDraws) {
  const std::string svg = run_gnuplot("set terminal svg\nplot x\n");
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
}

TEST(RunGnuplot, IsAnErrorOfTheEnvironmentIfItIsNotThere) {
  const test::TemporaryFolder nothing;
  const test::SearchPath path(nothing.path().string());
  try {
    (void)run_gnuplot("");
    FAIL() << "no exception";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_THAT(error.what(), HasSubstr("cannot run gnuplot"));
  }
  EXPECT_FALSE(has_child_left());
}

TEST(RunGnuplot, TellsWhatGnuplotComplainsOf) {
  EXPECT_THAT(
      test::message_of([] { (void)run_gnuplot("no such command\n"); }),
      testing::AllOf(HasSubstr("gnuplot ended with status 1"), HasSubstr("no such command")));
  EXPECT_FALSE(has_child_left());
}

TEST(RunGnuplot, TellsOfTheSignalThatEndedIt) {
  const FakeGnuplot killed("kill -9 $$");
  EXPECT_THAT(test::message_of([] { (void)run_gnuplot(""); }), HasSubstr("ended by signal 9"));
  EXPECT_FALSE(has_child_left());
}

TEST(RunGnuplot, WaitsForNobodyWhereMuchIsWrittenAndNothingRead) {
  const FakeGnuplot talkative("head -c 3000000 /dev/zero; head -c 3000000 /dev/zero >&2");
  constexpr std::size_t much = 3'000'000;
  EXPECT_EQ(run_gnuplot(std::string(much, ' ')).size(), much);
}

TEST(RunGnuplot, GivesItNoSettingsAndNoEnvironmentOfItsUser) {
  const FakeGnuplot talkative("echo \"$@\"; env");
  setenv("GNUPLOT_LIB", "somewhere", 1);
  const std::string said = run_gnuplot("");
  unsetenv("GNUPLOT_LIB");
  EXPECT_THAT(said, HasSubstr("--default-settings"));
  EXPECT_THAT(said, testing::Not(HasSubstr("GNUPLOT_LIB")));
}

}  // namespace
}  // namespace gonio

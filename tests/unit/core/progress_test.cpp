#include "emulator/core/progress.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

namespace gonio {
namespace {

using std::chrono::steady_clock;

/// While it lives, stderr is a terminal.
class TerminalOnStderr {
 public:
  TerminalOnStderr() : saved_(dup(STDERR_FILENO)), master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) {
      throw std::system_error(errno, std::generic_category(), "posix_openpt");
    }
    const int terminal = open(ptsname(master_), O_RDWR | O_NOCTTY);
    std::fflush(stderr);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
  }
  ~TerminalOnStderr() {
    restore();
    close(master_);
  }
  TerminalOnStderr(const TerminalOnStderr&) = delete;
  TerminalOnStderr& operator=(const TerminalOnStderr&) = delete;

  /// Ends it. @return  what was written.
  std::string text() {
    restore();  // nobody writes any more, so that reading comes to an end
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t size = 0; (size = read(master_, part.data(), part.size())) > 0;) {
      text.append(part.data(), std::size_t(size));
    }
    return text;
  }

 private:
  void restore() {
    if (saved_ >= 0) {
      std::fflush(stderr);
      dup2(saved_, STDERR_FILENO);
      close(saved_);
      saved_ = -1;
    }
  }
  int saved_;
  int master_;
};

TEST(Progress, IsSilentWhereStderrIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress(3, "samples");
    for (int i = 0; i < 3; ++i) {
      progress.advance();
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, IsSilentForShortWorkOnATerminal) {
  TerminalOnStderr terminal;
  {
    Progress progress(3, "samples");
    progress.advance();
  }
  EXPECT_EQ(terminal.text(), "");
}

TEST(Progress, ShowsRateAndTimeLeftAfterTwoSecondsOnATerminalAndClearsItself) {
  TerminalOnStderr terminal;
  const auto start = steady_clock::now();
  {
    Progress progress(std::numeric_limits<std::size_t>::max() / 64, "samples");
    while (steady_clock::now() - start < std::chrono::milliseconds(2300)) {
      progress.advance();
    }
  }
  const std::string text = terminal.text();
  EXPECT_THAT(text, testing::StartsWith("\r["));
  EXPECT_THAT(text, testing::HasSubstr(" samples, "));
  EXPECT_THAT(text, testing::HasSubstr("/s, "));
  EXPECT_THAT(text, testing::HasSubstr(" s left"));
  EXPECT_THAT(text, testing::EndsWith("\r\033[K"));
}

}  // namespace
}  // namespace gonio

#include "emulator/core/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace gonio {

Progress::Progress(std::size_t total, std::string noun)
    : total_(total),
      noun_(std::move(noun)),
      start_(Clock::now()),
      shown_(start_),
      is_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (is_visible_) {
    fmt::print(stderr, "\r\033[K");
  }
}

void Progress::advance() {
  using std::chrono::duration;
  ++done_;
  const auto now = Clock::now();
  const double elapsed_s = duration<double>(now - start_).count();
  if (!is_terminal_ || elapsed_s < 2.0 || duration<double>(now - shown_).count() < 0.2) {
    return;
  }
  constexpr std::size_t width = 30;
  const std::size_t filled = width * done_ / total_;
  const double rate = double(done_) / elapsed_s;
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}/{} {}, {:.1f}/s, {:.0f} s left \033[K", "", filled, "",
             width - filled, done_, total_, noun_, rate, double(total_ - done_) / rate);
  std::fflush(stderr);
  shown_ = now;
  is_visible_ = true;
}

}  // namespace gonio

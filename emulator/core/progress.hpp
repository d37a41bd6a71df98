#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace gonio {

/// A progress bar on stderr with the rate and the time left. It shows itself only on a terminal,
/// and only for work of more than two seconds.
class Progress {
 public:
  /// @param total  steps of the work.   @param noun  what a step is, in the plural.
  Progress(std::size_t total, std::string noun);
  ~Progress();  ///< clears the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance();  ///< one step is done; calls must not overlap

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t total_;
  std::size_t done_ = 0;
  std::string noun_;
  Clock::time_point start_;
  Clock::time_point shown_;
  bool is_terminal_;
  bool is_visible_ = false;
};

}  // namespace gonio

#pragma once

#include <poll.h>

#include <chrono>

namespace gonio::test {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// A moment that is not to be passed.
class Deadline {
 public:
  explicit Deadline(milliseconds from_now) : at_(Clock::now() + from_now) {}

  [[nodiscard]] bool is_over() const { return Clock::now() >= at_; }
  /// What is left for poll(), rounded up.
  [[nodiscard]] int left_ms() const {
    const auto left = std::chrono::ceil<milliseconds>(at_ - Clock::now()).count();
    return left > 0 ? int(left) : 0;
  }

 private:
  Clock::time_point at_;
};

/// @return  whether the descriptor can be read (or has failed) before the deadline.
inline bool is_readable(int file, const Deadline& deadline, short events = POLLIN) {
  pollfd entry{file, events, 0};
  return poll(&entry, 1, deadline.left_ms()) > 0;
}

/// Lets time pass, as a part of what is done to a server.
inline void pause(milliseconds time) {
  for (const Deadline deadline(time); !deadline.is_over();) {
    poll(nullptr, 0, deadline.left_ms());
  }
}

/// Looks again and again. @return  whether it became true in time.
template <class Predicate>
bool becomes_true(Predicate predicate, milliseconds within = milliseconds(5000)) {
  const Deadline deadline(within);
  while (!predicate()) {
    if (deadline.is_over()) {
      return false;
    }
    poll(nullptr, 0, 1);
  }
  return true;
}

}  // namespace gonio::test

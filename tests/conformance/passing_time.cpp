#include "tests/conformance/passing_time.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gonio::conformance {

namespace {

/// "8 h", "2.5 min", "40 s".
std::string duration_text(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds >= hour) {
    return fmt::format("{:.3g} h", seconds / hour);
  }
  return seconds >= minute ? fmt::format("{:.3g} min", seconds / minute)
                           : fmt::format("{:.3g} s", seconds);
}

}  // namespace

void PassingTime::observe(double waited_s, double uptime_s) {
  passed_s_ += uptime_s >= uptime_s_ ? uptime_s - uptime_s_ : uptime_s;
  uptime_s_ = uptime_s;
  waited_s_ = waited_s;
}

double PassingTime::least_total_s() const {
  return waited_s_ < least_waited_s ? 0.0 : waited_s_ * wanted_s_ / (passed_s_ + resolution_s);
}

std::string PassingTime::too_long_text() const {
  // A second more or less says nothing about a device that is not faster than the world.
  const bool is_fast = passed_s_ > waited_s_ + resolution_s;
  const double total_s = is_fast ? waited_s_ * wanted_s_ / passed_s_ : wanted_s_;
  return fmt::format("would take {}; allow it with --patience", duration_text(total_s));
}

}  // namespace gonio::conformance

#pragma once

#include <string>

namespace gonio::conformance {

/// How a device's own time passes, by what its uptime shows: whole seconds, which fall back to 0 if
/// it restarts. It may be faster than that of the world.
class PassingTime {
 public:
  /// @param wanted_s  of the device, > 0.
  PassingTime(double wanted_s, double uptime_s) : wanted_s_(wanted_s), uptime_s_(uptime_s) {}

  /// @param waited_s  since the beginning, in the world's time.
  void observe(double waited_s, double uptime_s);

  /// All of it has passed, though the uptime at the beginning may have been almost a second more
  /// than what it showed.
  [[nodiscard]] bool is_over() const { return passed_s_ >= wanted_s_ + resolution_s; }
  /// How long it takes from the beginning, in the world's time, if the device is as fast as it
  /// can be by what was seen; 0 while too little was seen.
  [[nodiscard]] double least_total_s() const;
  /// e.g. "would take 8 h; allow it with --patience".
  [[nodiscard]] std::string too_long_text() const;

 private:
  static constexpr double resolution_s = 1.0;
  static constexpr double least_waited_s = 0.2;  ///< before one can tell how fast a device is

  double wanted_s_, uptime_s_;
  double waited_s_ = 0.0, passed_s_ = 0.0;
};

}  // namespace gonio::conformance

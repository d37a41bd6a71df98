#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gonio {

/// Time since power on, in whole nanoseconds, so that steps of any size add up to the same moment.
using DeviceTime = std::chrono::nanoseconds;

/// 100 years. A longer duration is cut to it, so that no sum of two overflows.
constexpr double longest_time_s = 3.156e9;

[[nodiscard]] inline DeviceTime to_device_time(double seconds) {
  return DeviceTime(std::llround(std::clamp(seconds, 0.0, longest_time_s) * 1e9));
}

[[nodiscard]] inline double to_seconds(DeviceTime time) { return double(time.count()) / 1e9; }

}  // namespace gonio

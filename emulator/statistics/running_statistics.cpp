#include "emulator/statistics/running_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

void RunningStatistics::add(double x) {
  ChannelStatistics& r = result_;
  r.minimum = r.n == 0 ? x : std::min(r.minimum, x);
  r.maximum = r.n == 0 ? x : std::max(r.maximum, x);
  ++r.n;
  const double from_last_mean = x - r.mean;
  // The first value is its own mean: x - 0 over 1.
  r.mean += from_last_mean / r.n;
  sum_of_squares_ += from_last_mean * (x - r.mean);
  r.standard_deviation = r.n < 2 ? 0.0 : std::sqrt(sum_of_squares_ / (r.n - 1));
}

}  // namespace gonio

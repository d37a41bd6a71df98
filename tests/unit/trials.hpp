#pragma once

#include <cmath>
#include <cstddef>

namespace gonio::test {

/// How often an experiment is repeated: as often as the test says, but a tenth of that under a
/// sanitizer, which looks at memory and threads and takes ten times as long.
constexpr std::size_t trials(std::size_t n) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return n / 10;
#else
  return n;
#endif
}

/// By how much the share of n trials may be off from 95 % for chance alone, with so many standard
/// deviations.
inline double chance_about_95_percent(std::size_t n, double standard_deviations) {
  return standard_deviations * std::sqrt(0.95 * 0.05 / double(n));
}

}  // namespace gonio::test

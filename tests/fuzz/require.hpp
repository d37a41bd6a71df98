#pragma once

#include <cstdio>
#include <cstdlib>

namespace gonio::test {

/// Ends the fuzzer with a finding if a property does not hold.
inline void require(bool holds, const char* property) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", property);
    std::abort();
  }
}

}  // namespace gonio::test

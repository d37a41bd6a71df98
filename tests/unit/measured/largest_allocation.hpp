#pragma once

#include <cstddef>

namespace gonio::test {

/// Watches operator new of this program on this thread while it lives; one at a time.
class LargestAllocation {
 public:
  LargestAllocation();
  ~LargestAllocation();
  LargestAllocation(const LargestAllocation&) = delete;
  LargestAllocation& operator=(const LargestAllocation&) = delete;

  /// The most that was asked for at once.
  [[nodiscard]] std::size_t bytes() const;
};

}  // namespace gonio::test

#include "tests/unit/measured/largest_allocation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

namespace {

thread_local bool is_watched = false;
thread_local std::size_t largest = 0;

}  // namespace

// The forms for arrays call these. Not inline, or gcc 12 takes malloc() and free() for a mismatch
// with the forms that it does not see.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*form*/) noexcept {
  if (is_watched) {
    largest = std::max(largest, size);
  }
  return std::malloc(size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* const memory = operator new(size, std::nothrow);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace gonio::test {

LargestAllocation::LargestAllocation() {
  largest = 0;
  is_watched = true;
}
LargestAllocation::~LargestAllocation() { is_watched = false; }

std::size_t LargestAllocation::bytes() const { return largest; }

namespace {

TEST(LargestAllocation, IsSeen) {
  const LargestAllocation watch;
  const std::vector<double> numbers(1000);
  EXPECT_EQ(watch.bytes(), 8 * numbers.size());
}

}  // namespace
}  // namespace gonio::test

#include "tests/conformance/passing_time.hpp"

#include <gtest/gtest.h>

namespace gonio::conformance {
namespace {

TEST(PassingTime, IsOverWhenAllOfItHasSurelyPassed) {
  PassingTime time(10.0, 5.0);  // 5 s may be 5.99 s
  time.observe(10.5, 15.0);
  EXPECT_FALSE(time.is_over());
  time.observe(11.1, 16.0);
  EXPECT_TRUE(time.is_over());
}

TEST(PassingTime, GoesOnOverARestart) {
  PassingTime time(10.0, 100.0);
  time.observe(4.0, 104.0);
  time.observe(5.0, 0.0);
  EXPECT_FALSE(time.is_over());
  time.observe(12.0, 7.0);
  EXPECT_TRUE(time.is_over());
}

TEST(PassingTime, KnowsNoSpeedFromTooShortATime) {
  PassingTime time(1e6, 0.0);
  time.observe(0.1, 0.0);
  EXPECT_EQ(time.least_total_s(), 0.0);
}

TEST(PassingTime, FindsTheDeviceAsFastAsItsUptimeAllows) {
  PassingTime time(8 * 3600.0, 0.0);
  time.observe(0.25, 899.0);
  EXPECT_DOUBLE_EQ(time.least_total_s(), 8.0);
  PassingTime slow(8 * 3600.0, 0.0);
  slow.observe(0.25, 0.0);
  EXPECT_DOUBLE_EQ(slow.least_total_s(), 7200.0);  // by a second that may have almost passed
}

TEST(PassingTime, SaysHowLongItWouldTake) {
  PassingTime slow(8 * 3600.0, 0.0);
  slow.observe(0.25, 1.0);
  EXPECT_EQ(slow.too_long_text(), "would take 8 h; allow it with --patience");
  PassingTime fast(8 * 3600.0, 0.0);
  fast.observe(0.5, 20.0);
  EXPECT_EQ(fast.too_long_text(), "would take 12 min; allow it with --patience");
}

}  // namespace
}  // namespace gonio::conformance

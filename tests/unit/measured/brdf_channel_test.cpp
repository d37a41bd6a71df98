#include "emulator/measured/brdf_channel.hpp"

#include <gtest/gtest.h>

namespace gonio::test {
namespace {

TEST(BrdfChannel, IsFoundByItsName) {
  for (const char* name : {"550nm", "405.5nm", "Luminance", "R", "G", "B", "X", "Y", "Z"}) {
    const auto channel = channel_named(name);
    ASSERT_TRUE(channel) << name;
    EXPECT_EQ(channel_name(*channel), name);
  }
  EXPECT_EQ(channel_named("550NM"), channel_named("550nm"));
  EXPECT_EQ(channel_named("r"), channel_named("R"));
}

TEST(BrdfChannel, IsNothingElse) {
  for (const char* name : {"", "nm", "-5nm", "0nm", "nannm", "550", "550um", "550 nm", "RGB"}) {
    EXPECT_FALSE(channel_named(name)) << name;
  }
}

}  // namespace
}  // namespace gonio::test

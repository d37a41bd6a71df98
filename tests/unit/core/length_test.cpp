#include "emulator/core/length.hpp"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Length, ConvertsBetweenNanometresAndMicrometres) {
  EXPECT_DOUBLE_EQ(micrometres(0.55).nanometres(), 550.0);
  EXPECT_DOUBLE_EQ(nanometres(550).micrometres(), 0.55);
}

TEST(Length, IsOrderedWhateverItsUnit) {
  EXPECT_LT(nanometres(780), micrometres(1));
  EXPECT_EQ(nanometres(2000), micrometres(2));
  EXPECT_EQ(Length(), nanometres(0));
}

}  // namespace
}  // namespace gonio

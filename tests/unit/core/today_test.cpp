#include "emulator/core/today.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

namespace gonio {
namespace {

TEST(Today, IsTheDayOfSourceDateEpochWhereThatIsSet) {
  setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  EXPECT_EQ(today(), "2023-11-14");
  setenv("SOURCE_DATE_EPOCH", "951782400", 1);
  EXPECT_EQ(today(), "2000-02-29");
  unsetenv("SOURCE_DATE_EPOCH");
}

TEST(Today, IsADateElse) {
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_TRUE(std::regex_match(today(), std::regex("20[0-9]{2}-[01][0-9]-[0-3][0-9]")));
}

}  // namespace
}  // namespace gonio

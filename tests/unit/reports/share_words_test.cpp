#include "reports/share_words.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ShareText, ShowsTwoDigitsOfWhatIsRare) {
  EXPECT_EQ(share_text(0.0), "0 %");
  EXPECT_EQ(share_text(1.0), "100 %");
  EXPECT_EQ(share_text(0.00042), "0.042 %");
  EXPECT_EQ(share_text(0.123), "12 %");
  EXPECT_EQ(share_text(0.9987), "99.87 %");
  EXPECT_EQ(share_text(1e-9), "< 0.0001 %");
  EXPECT_EQ(share_text(nan), "-");
}

TEST(ShareText, NeverSaysThatWhatIsNearlySureIsSure) {
  EXPECT_EQ(share_text(1.0 - 1e-9), "> 99.9999 %");
}

TEST(ShareText, HasTheBoundsOfAnEstimate) {
  EXPECT_EQ(share_text(Estimate{0.0042, 0.0025, 0.0066}), "0.42 % (0.25 to 0.66)");
}

TEST(ValueText, HasTwoDigitsOfTheSpreadAndItsSpreadThree) {
  EXPECT_EQ(value_text(60.4049, 0.83), "60.40");
  EXPECT_EQ(value_text(60.4049, 2.5), "60.4");
  EXPECT_EQ(spread_text(0.8312), "0.831");
  EXPECT_EQ(spread_text(2.5), "2.50");
  EXPECT_EQ(value_text(nan, 1.0), "-");
  EXPECT_EQ(spread_text(nan), "-");
}

}  // namespace
}  // namespace gonio

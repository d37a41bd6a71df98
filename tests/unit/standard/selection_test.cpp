#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "emulator/standard/standard.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

// ISO 2813 and ASTM D523: 60 deg for most, 20 deg above 70 GU, 85 deg below 10 GU, both strictly.

namespace gonio {
namespace {

std::optional<std::string> selected(const std::string& standard, double gloss_60) {
  return test::shipped_standard(standard).select_geometry(
      {{"20", 1.0}, {"60", gloss_60}, {"85", 1.0}});
}

TEST(StandardSelectGeometry, KeepsSixtyDegreesAtTheLimits) {
  for (const char* id : {"iso_2813/2014", "astm_d523/14", "jis_k_5600_4_7/1999"}) {
    EXPECT_EQ(selected(id, 70.0), "60") << id;
    EXPECT_EQ(selected(id, 10.0), "60") << id;
    EXPECT_EQ(selected(id, 40.0), "60") << id;
  }
}

TEST(StandardSelectGeometry, LeavesSixtyDegreesStrictlyBeyondTheLimits) {
  for (const char* id : {"iso_2813/2014", "astm_d523/14", "jis_k_5600_4_7/1999"}) {
    EXPECT_EQ(selected(id, 70.0001), "20") << id;
    EXPECT_EQ(selected(id, std::nextafter(70.0, 71.0)), "20") << id;
    EXPECT_EQ(selected(id, 2000.0), "20") << id;
    EXPECT_EQ(selected(id, 9.9999), "85") << id;
    EXPECT_EQ(selected(id, std::nextafter(10.0, 9.0)), "85") << id;
    EXPECT_EQ(selected(id, 0.0), "85") << id;
  }
}

TEST(StandardSelectGeometry, SaysNothingWithoutTheFirstGeometry) {
  const Standard standard = test::shipped_standard("iso_2813/2014");
  EXPECT_EQ(standard.select_geometry({}), std::nullopt);
  EXPECT_EQ(standard.select_geometry({{"20", 90.0}, {"85", 99.0}}), std::nullopt);
}

TEST(StandardSelectGeometry, SaysNothingWhereTheStandardHasNoRule) {
  EXPECT_EQ(selected("iso_7668/2018", 90.0), std::nullopt);
}

}  // namespace
}  // namespace gonio

#include "emulator/core/unit_value.hpp"

#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

UnitValue read(const std::string& text) {
  return read_unit_value(
      YamlMap(YamlNode::parse("value: " + text, "limits.yaml")).required("value"));
}

TEST(UnitValue, HasTheUnitItIsStatedIn) {
  EXPECT_DOUBLE_EQ(read("0.1 deg").value, 0.1);
  EXPECT_EQ(read("0.1 deg").unit, "deg");
  EXPECT_EQ(read("1 GU").unit, "GU");
  EXPECT_EQ(read("0.01").unit, "");
}

TEST(UnitValue, IsBroughtToItsUsualUnit) {
  EXPECT_DOUBLE_EQ(read("8 h").value, 8 * 3600.0);
  EXPECT_EQ(read("8 h").unit, "s");
}

TEST(UnitValue, RefusesWhatIsNone) {
  EXPECT_EQ(test::message_of([] { (void)read("1 foot"); }),
            "limits.yaml:1:8: value: expected a number, with its unit if it has one (deg, GU, s, "
            "min, h, nm, K), found '1 foot'");
}

}  // namespace
}  // namespace gonio

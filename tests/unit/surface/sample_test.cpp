#include "emulator/surface/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using testing::EndsWith;

const WavelengthGrid one_wavelength(nanometres(555), nanometres(1), 1);

/// A mirror with one more line, 4, in its file.
Sample mirror_with(const std::string& line) {
  const test::TemporaryFolder folder;
  return load_sample(
      folder.file("mine.yaml", "schema: gonio/sample/1\nid: mine\ntitle: Mine\n" + line +
                                   "\nsurface: {model: smooth, reflectance: 1}\n"),
      one_wavelength);
}

TEST(SampleTilt, IsZeroUnlessTheFileSays) {
  EXPECT_EQ(mirror_with("").tilt, degrees(0));
  EXPECT_EQ(mirror_with("tilt: 0.25 deg").tilt, degrees(0.25));
  EXPECT_EQ(mirror_with("tilt: -45 deg").tilt, degrees(-45));
}

TEST(SampleTilt, BeyondItsRangeOrWithoutAUnitIsRefusedAtItsPlace) {
  const std::string expected =
      "mine.yaml:4:7: tilt: expected an angle (deg, rad, mrad) in [-45, 45], found ";
  EXPECT_THAT(message_of([] { (void)mirror_with("tilt: 45.1 deg"); }),
              EndsWith(expected + "'45.1 deg'"));
  EXPECT_THAT(message_of([] { (void)mirror_with("tilt: 0.25"); }), EndsWith(expected + "'0.25'"));
}

}  // namespace
}  // namespace gonio

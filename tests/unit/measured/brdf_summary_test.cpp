#include "emulator/measured/brdf_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/measured/measured_fixture.hpp"

namespace gonio::test {
namespace {

TEST(BrdfSummary, TellsOfAnglesThatWereMeasured) {
  const BrdfSummary summary = summarize(load_brdf(brdf_fixtures + "colodur_napoli_4f.zemax.bsdf"));
  EXPECT_EQ(summary.format, BrdfFormat::zemax);
  ASSERT_EQ(summary.rows.size(), 5u);  // 0 to 75 degrees
  EXPECT_NEAR(summary.rows[2].theta_i.degrees(), 45.0, 1e-12);
  EXPECT_NEAR(summary.rows[2].step.degrees(), 1.0, 1e-9);
  EXPECT_GT(summary.rows[2].reflectance[0], 0.1);
  EXPECT_TRUE(summary.warnings.empty());
}

TEST(BrdfSummary, WarnsOfATableThatIsTooCoarseForItsLobe) {
  const BrdfSummary summary = summarize(load_brdf(brdf_fixtures + "satin_rosaline.astm"));
  ASSERT_EQ(summary.warnings.size(), 1u);
  EXPECT_THAT(summary.warnings[0], testing::StartsWith("at 75 deg it would reflect 1."));
}

}  // namespace
}  // namespace gonio::test

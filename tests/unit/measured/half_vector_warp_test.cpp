#include "emulator/measured/half_vector_warp.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_close.hpp"

namespace gonio::test {
namespace {

constexpr float rounding = 1e-6F;
const TableBlend first{.count = 1, .table = {0}, .weight = {1.0F}};

TEST(HalfVectorWarp, IsTheIdentityForAUniformDensity) {
  const HalfVectorWarp warp({4, 5}, std::vector<float>(20, 3.0F));
  for (const float x : {0.0F, 0.1F, 0.5F, 0.77F, 1.0F}) {
    for (const float y : {0.0F, 0.3F, 1.0F}) {
      const auto [u, v] = warp.invert(first, x, y);
      EXPECT_TRUE(is_close(u, x, rounding));
      EXPECT_TRUE(is_close(v, y, rounding));
    }
  }
}

TEST(HalfVectorWarp, IsTheIntegralOfALinearDensity) {
  // Density 4 x y: marginal distribution y^2, conditional x^2, whatever the grid.
  std::vector<float> density;
  for (const float y : {0.0F, 0.5F, 1.0F}) {
    for (const float x : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
      density.push_back(4.0F * x * y);
    }
  }
  const HalfVectorWarp warp({3, 5}, density);
  for (const float x : {0.1F, 0.6F, 1.0F}) {
    for (const float y : {0.2F, 0.9F, 1.0F}) {
      const auto [u, v] = warp.invert(first, x, y);
      EXPECT_TRUE(is_close(u, x * x, rounding));
      EXPECT_TRUE(is_close(v, y * y, rounding));
    }
  }
}

TEST(HalfVectorWarp, BlendsDensitiesAndNotTheirWarps) {
  // Half of 2 x and half of 2 (1 - x) is 1.
  const HalfVectorWarp warp({2, 2}, {0.0F, 2.0F, 0.0F, 2.0F, 2.0F, 0.0F, 2.0F, 0.0F});
  const TableBlend half{.count = 2, .table = {0, 1}, .weight = {0.5F, 0.5F}};
  EXPECT_TRUE(is_close(warp.invert(half, 0.3F, 0.5F).first, 0.3F, rounding));
  EXPECT_TRUE(is_close(warp.invert(first, 0.3F, 0.5F).first, 0.09F, rounding));
}

TEST(HalfVectorWarp, FindsATableWithoutDensity) {
  EXPECT_EQ(HalfVectorWarp({2, 2}, {1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F}).empty_table(),
            1U);
  const HalfVectorWarp all({2, 2}, {1.0F, 0.0F, 0.0F, 0.0F});
  EXPECT_EQ(all.empty_table(), all.tables());
}

TEST(TableBlend, IsLinearInBothAnglesAndConstantBeyondThem) {
  const std::vector<float> phi_i{-3.0F, 0.0F, 3.0F};
  const std::vector<float> theta_i{0.0F, 1.0F};
  const TableBlend blend = table_blend(phi_i, theta_i, 0.75, 0.5);
  ASSERT_EQ(blend.count, 4);
  EXPECT_EQ(blend.table, (std::array<std::size_t, 4>{2, 3, 4, 5}));
  EXPECT_EQ(blend.weight, (std::array<float, 4>{0.375F, 0.375F, 0.125F, 0.125F}));
  const TableBlend beyond = table_blend(phi_i, theta_i, 4.0, 2.0);
  EXPECT_EQ(beyond.count, 1);
  EXPECT_EQ(beyond.table[0], 5U);
  EXPECT_EQ(table_blend(phi_i, theta_i, -4.0, 0.0).table[0], 0U);
}

}  // namespace
}  // namespace gonio::test

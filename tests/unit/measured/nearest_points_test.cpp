#include "emulator/measured/nearest_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gonio::test {
namespace {

TEST(NearestPoints, AreThoseOfACompleteSearch) {
  constexpr unsigned seed = 3;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Eigen::ArrayXXd points = Eigen::ArrayXXd::NullaryExpr(500, 4, [&] { return unit(random); });
  points.bottomRows(50) = points.topRows(50);  // some twice
  const NearestPoints nearest(points);
  for (int i = 0; i < 50; ++i) {
    const Eigen::ArrayXd place = Eigen::ArrayXd::NullaryExpr(4, [&] { return unit(random); });
    std::vector<double> all;
    for (Eigen::Index row = 0; row < points.rows(); ++row) {
      all.push_back((points.row(row).transpose() - place).square().sum());
    }
    std::ranges::sort(all);
    std::vector<std::pair<double, Eigen::Index>> found;
    nearest.find(place, 6, found);
    ASSERT_EQ(found.size(), 6u);
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_EQ(found[j].first, all[j]);
    }
  }
}

TEST(NearestPoints, AreAllIfTheyAreFewer) {
  std::vector<std::pair<double, Eigen::Index>> found;
  NearestPoints(Eigen::ArrayXXd::Ones(2, 3)).find(Eigen::ArrayXd::Zero(3), 6, found);
  EXPECT_EQ(found.size(), 2u);
}

}  // namespace
}  // namespace gonio::test

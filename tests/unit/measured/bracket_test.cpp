#include "emulator/measured/bracket.hpp"

#include <gtest/gtest.h>

namespace gonio::test {
namespace {

using std::numbers::pi;

TEST(Bracket, HoldsAPlaceBetweenNodes) {
  const Eigen::ArrayXd nodes = Eigen::Array3d(1.0, 2.0, 4.0);
  EXPECT_EQ(bracket(nodes, 3.0).first, 1);
  EXPECT_EQ(bracket(nodes, 3.0).second, 2);
  EXPECT_DOUBLE_EQ(bracket(nodes, 3.5).weight, 0.75);
  EXPECT_EQ(bracket(nodes, 3.5).nearest(), 2);
}

TEST(Bracket, IsTheOutermostNodeBeyondThem) {
  const Eigen::ArrayXd nodes = Eigen::Array3d(1.0, 2.0, 4.0);
  EXPECT_EQ(bracket(nodes, 0.0).nearest(), 0);
  EXPECT_EQ(bracket(nodes, 9.0).nearest(), 2);
  EXPECT_EQ(bracket(nodes, 9.0).weight, 0.0);
  EXPECT_EQ(bracket(Eigen::ArrayXd::Zero(1), 5.0).nearest(), 0);
}

TEST(Bracket, GoesRoundTheCircle) {
  const Eigen::ArrayXd nodes = Eigen::Array3d(0.0, pi / 2.0, pi);
  const Bracket last = bracket_on_circle(nodes, 1.75 * pi);
  EXPECT_EQ(last.first, 2);
  EXPECT_EQ(last.second, 0);
  EXPECT_DOUBLE_EQ(last.weight, 0.75);
  const Eigen::ArrayXd later = Eigen::Array2d(1.0, 2.0);
  EXPECT_EQ(bracket_on_circle(later, 0.5).first, 1);
  EXPECT_GT(bracket_on_circle(later, 0.5).weight, 0.8);
}

TEST(Bracket, TakesAnglesByWholeTurns) {
  EXPECT_DOUBLE_EQ(in_one_turn(-pi / 2.0), 1.5 * pi);
  EXPECT_DOUBLE_EQ(in_one_turn(5.0 * pi), pi);
  EXPECT_EQ(in_one_turn(-1e-30), 0.0);
}

}  // namespace
}  // namespace gonio::test

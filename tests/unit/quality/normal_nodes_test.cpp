#include "emulator/quality/normal_nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using test::is_close;

/// As the function says.
constexpr double stated_error = 1e-9;

double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double mean_of(const std::vector<NormalNode>& nodes, auto f) {
  double sum = 0.0;
  for (const NormalNode& node : nodes) {
    sum += node.weight * f(node.x);
  }
  return sum;
}

// The sum of two normal values is normal: E[Phi((a - x) / s)] = Phi(a / sqrt(s^2 + sd^2)).
TEST(NormalNodes, AverageWhatIsBlurredOverAnyScale) {
  for (const double sd : {0.01, 0.5, 3.0}) {
    for (const double scale : {0.0, 1e-4, 0.1, 2.0, 50.0}) {
      for (const double place : {-4.0, -0.3, 0.0, 1.0, 7.0}) {
        const auto nodes = normal_nodes(sd, {place}, scale);
        const auto f = [&](double x) {
          return scale == 0.0 ? (x < place ? 1.0 : 0.0) : below((place - x) / scale);
        };
        EXPECT_TRUE(is_close(mean_of(nodes, f), below(place / std::hypot(sd, scale)), stated_error))
            << "sd " << sd << ", scale " << scale << ", place " << place;
      }
    }
  }
}

TEST(NormalNodes, HaveTheMomentsOfTheDistribution) {
  const auto nodes = normal_nodes(2.0, {}, 1.0);
  EXPECT_TRUE(is_close(mean_of(nodes, [](double) { return 1.0; }), 1.0, stated_error));
  EXPECT_TRUE(is_close(mean_of(nodes, [](double x) { return x; }), 0.0, stated_error));
  // Beyond the reach there is a little more of a square than of a probability.
  EXPECT_TRUE(is_close(mean_of(nodes, [](double x) { return x * x; }), 4.0, 100 * stated_error));
}

TEST(NormalNodes, AreOneWithoutSpread) {
  const auto nodes = normal_nodes(0.0, {1.0}, 1.0);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].x, 0.0);
  EXPECT_EQ(nodes[0].weight, 1.0);
}

}  // namespace
}  // namespace gonio

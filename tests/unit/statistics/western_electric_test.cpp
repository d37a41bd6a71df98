#include "emulator/statistics/western_electric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using Points = std::vector<std::size_t>;

/// The points, from 1, at which a rule speaks.
Points points_of(int rule, const std::vector<double>& z, double side = 1.0) {
  WesternElectric rules;
  Points points;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (rules.add(side * z[i])[std::size_t(rule - 1)]) {
      points.push_back(i + 1);
    }
  }
  return points;
}

void expect_points(int rule, const std::vector<double>& z, const Points& expected) {
  EXPECT_EQ(points_of(rule, z, 1.0), expected);
  EXPECT_EQ(points_of(rule, z, -1.0), expected) << "on the other side";
}

TEST(WesternElectric, Rule1SpeaksAtAPointBeyondThreeSigma) {
  expect_points(1, {0.0, 2.9, 3.1, 3.0, -3.1, 0.0}, {3, 5});
}

TEST(WesternElectric, Rule2SpeaksAtTheSecondOfTwoAmongThreeBeyondTwoSigma) {
  expect_points(2, {0.0, 2.1, 0.0, 2.1, 0.0}, {4});
  expect_points(2, {0.0, 2.1, 2.2, 0.0, 0.0}, {3});
  expect_points(2, {2.1, 0.0, 0.0, 2.1}, {});
  expect_points(2, {2.1, -2.1, 0.0}, {});
  expect_points(2, {2.1, 2.0, 0.0}, {});
  // On from there each further point that has another among the last three.
  expect_points(2, {2.1, 2.1, 2.1, 0.0, 2.1, 0.0}, {2, 3, 5});
}

TEST(WesternElectric, Rule3SpeaksAtTheFourthOfFourAmongFiveBeyondOneSigma) {
  expect_points(3, {0.0, 1.1, 1.2, 0.0, 1.1, 1.1, 0.0}, {6});
  expect_points(3, {1.1, 1.1, 1.1, 1.1, 0.0, 1.1}, {4, 6});
  expect_points(3, {1.1, 1.1, 1.1, 0.0, 0.0, 1.1}, {});
  expect_points(3, {1.1, 1.1, 1.1, -1.1, 0.0}, {});
  expect_points(3, {1.1, 1.1, 1.1, 1.0}, {});
}

TEST(WesternElectric, Rule4SpeaksAtTheEighthInARowOnOneSideAndAtAllFurther) {
  const double some = 0.1;
  expect_points(4, {-some, some, some, some, some, some, some, some, some, -some}, {9});
  expect_points(4, std::vector<double>(10, some), {8, 9, 10});
  expect_points(4, std::vector<double>(7, some), {});
  // A point on the centre ends a run.
  std::vector<double> broken(15, some);
  broken[7] = 0.0;
  expect_points(4, broken, {});
}

TEST(WesternElectric, RulesSpeakTogether) {
  WesternElectric rules;
  WesternElectric::Broken last = {};
  for (int i = 0; i < 8; ++i) {
    last = rules.add(3.5);
  }
  EXPECT_EQ(last, (WesternElectric::Broken{true, true, true, true}));
}

// Seed 37; a million points in control. Each rule breaks as often as its probability at one point
// says: 2 Q(3); 2 P(Z > 2 and one of two others); 2 P(Z > 1 and three or all of four others);
// 2 / 2^8. Points in a row are not independent for rules 2 to 4: their rates vary by more than
// their square roots, by less than three times that.
TEST(WesternElectric, RulesBreakByChanceAsOftenAsNormalTailsSay) {
  const std::size_t points = test::trials(1000000);
  std::mt19937_64 random(37);
  std::normal_distribution<double> normal;
  WesternElectric rules;
  std::array<double, western_electric_rules> counts = {};
  for (std::size_t i = 0; i < points; ++i) {
    const WesternElectric::Broken broken = rules.add(normal(random));
    for (std::size_t rule = 0; rule < broken.size(); ++rule) {
      counts[rule] += broken[rule];
    }
  }
  const auto above = [](double z) { return std::erfc(z / std::sqrt(2.0)) / 2.0; };
  const double q1 = above(1.0), q2 = above(2.0);
  const std::array<double, western_electric_rules> expected = {
      2.0 * above(3.0), 2.0 * q2 * (1.0 - (1.0 - q2) * (1.0 - q2)),
      2.0 * q1 * (4.0 * q1 * q1 * q1 * (1.0 - q1) + q1 * q1 * q1 * q1), 2.0 / 256.0};
  for (std::size_t rule = 0; rule < expected.size(); ++rule) {
    const double root = std::sqrt(expected[rule] / double(points));
    EXPECT_TRUE(test::is_close(counts[rule] / double(points), expected[rule],
                               (rule == 0 ? 4.0 : 12.0) * root))
        << "rule " << rule + 1;
  }
}

}  // namespace
}  // namespace gonio

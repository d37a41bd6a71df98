#include "emulator/standard/decision.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace gonio {
namespace {

using enum ConformanceVerdict;

constexpr Interval around_60{.low = 59.9, .high = 60.1};

TEST(Decide, PassesWithinTheLimitByMoreThanU) {
  EXPECT_EQ(decide(60.04, 0.05, around_60, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(59.96, 0.05, around_60, DecisionRule::guarded), pass);
}

TEST(Decide, FailsBeyondTheLimitByMoreThanU) {
  EXPECT_EQ(decide(60.16, 0.05, around_60, DecisionRule::guarded), fail);
  EXPECT_EQ(decide(59.84, 0.05, around_60, DecisionRule::guarded), fail);
}

TEST(Decide, IsInconclusiveWhereUReachesOverTheLimit) {
  EXPECT_EQ(decide(60.06, 0.05, around_60, DecisionRule::guarded), inconclusive);
  EXPECT_EQ(decide(60.14, 0.05, around_60, DecisionRule::guarded), inconclusive);
  EXPECT_EQ(decide(59.86, 0.05, around_60, DecisionRule::guarded), inconclusive);
}

TEST(Decide, ByTheSimpleRuleTakesTheValueAlone) {
  EXPECT_EQ(decide(60.09, 0.05, around_60, DecisionRule::simple), pass);
  EXPECT_EQ(decide(60.11, 0.05, around_60, DecisionRule::simple), fail);
}

TEST(Decide, PassesAtTheLimitItself) {
  EXPECT_EQ(decide(60.1, 0.0, around_60, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(60.0 + 0.1, 0.0, around_60, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(60.05, 0.05, around_60, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(60.100001, 0.0, around_60, DecisionRule::guarded), fail);
}

TEST(Decide, KnowsLimitsOnOneSide) {
  EXPECT_EQ(decide(0.4, 0.05, {.high = 0.5}, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(-7.0, 0.05, {.high = 0.5}, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(0.6, 0.05, {.high = 0.5}, DecisionRule::guarded), fail);
  EXPECT_EQ(decide(0.6, 0.05, {.low = 0.5}, DecisionRule::guarded), pass);
  EXPECT_EQ(decide(0.48, 0.05, {.low = 0.5}, DecisionRule::guarded), inconclusive);
}

TEST(Decide, FailsWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(decide(nan, 0.0, around_60, DecisionRule::guarded), fail);
  EXPECT_EQ(decide(nan, 0.0, around_60, DecisionRule::simple), fail);
}

TEST(Worse, PutsWhatDecidesFirst) {
  EXPECT_EQ(worse(pass, fail), fail);
  EXPECT_EQ(worse(inconclusive, pass), inconclusive);
  EXPECT_EQ(worse(fail, error), error);
  EXPECT_EQ(worse(skipped, pass), pass);
  EXPECT_EQ(worse(not_applicable, skipped), skipped);
  EXPECT_EQ(worse(fail, inconclusive), fail);
}

TEST(ConformanceProbability, IsThatOfANormalValue) {
  EXPECT_DOUBLE_EQ(conformance_probability(60.1, 0.05, {.high = 60.1}), 0.5);
  // Tables of the normal distribution: 95.45 % within two standard deviations.
  EXPECT_NEAR(conformance_probability(60.0, 0.05, around_60), 0.9544997, 1e-7);
  EXPECT_NEAR(conformance_probability(60.15, 0.05, around_60), 0.1586553 - 2.87e-7, 1e-7);
}

TEST(ConformanceProbability, OfAValueWithoutUncertaintyIsAllOrNothing) {
  EXPECT_EQ(conformance_probability(60.1, 0.0, around_60), 1.0);
  EXPECT_EQ(conformance_probability(60.11, 0.0, around_60), 0.0);
  EXPECT_EQ(conformance_probability(60.1, 0.0, {}), 1.0);
}

}  // namespace
}  // namespace gonio

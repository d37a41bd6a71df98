#include "emulator/procedure/worst_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/core/parallel_for.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/responses.hpp"

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::is_close;
using test::nominal_iso_2813;
using test::rungs;
using test::tolerance_gu;
using testing::DoubleEq;
using testing::Pointwise;

constexpr double negligible_gu = 2e-5;  // what a deviation must make worse to count, and noise

/// Without tolerances on the source.
GeometryLimits with_given_source(GeometryLimits limits) {
  limits.source.in_plane->value->tolerance.reset();
  limits.source.perpendicular->value->tolerance.reset();
  return limits;
}

/// Readings at low, nominal and high of each quantity, as the optics have them; the nominal set-up
/// first.
std::vector<VectorXd> at_all_combinations(const OpticalResponse& response,
                                          const GeometryLimits& limits) {
  std::vector<VectorXd> setups{response.nominal()};
  for (std::size_t q = 0; q < response.quantities().size(); ++q) {
    const double tolerance = limit_of(limits, response.quantities()[q])->tolerance->degrees();
    const std::size_t n = setups.size();
    for (std::size_t i = 0; i < 2 * n; ++i) {
      setups.push_back(setups[i % n]);
      setups.back()(Index(q)) += i < n ? -tolerance : tolerance;
    }
  }
  std::vector<VectorXd> gloss_gu(setups.size());
  parallel_for(setups.size(), [&](std::size_t i) { gloss_gu[i] = response(setups[i]); });
  return gloss_gu;
}

/// No combination is worse, and each change is that of the set-up told with it.
void expect_worst_of_all(const Instrument& instrument, const std::string& geometry,
                         const std::vector<Sample>& ladder) {
  const GeometryLimits& limits = instrument.standard.geometry(geometry);
  const OpticalResponse response(instrument, geometry, ladder, tolerance_gu);
  const WorstCases found = worst_cases(response, limits);
  const VectorXd before = response(response.nominal());
  for (const VectorXd& gloss_gu : at_all_combinations(response, limits)) {
    for (std::size_t s = 0; s < ladder.size(); ++s) {
      const double change_gu = gloss_gu(Index(s)) - before(Index(s));
      EXPECT_LE(found.lowest[s].change_gu, change_gu + negligible_gu) << ladder[s].id;
      EXPECT_GE(found.highest[s].change_gu, change_gu - negligible_gu) << ladder[s].id;
    }
  }
  for (std::size_t s = 0; s < ladder.size(); ++s) {
    for (const WorstCase& worst : {found.lowest[s], found.highest[s]}) {
      VectorXd setup = response.nominal();
      std::ranges::copy(worst.setup, setup.begin());
      EXPECT_TRUE(is_close(response(setup)(Index(s)) - before(Index(s)), worst.change_gu,
                           2 * tolerance_gu));
    }
  }
}

TEST(WorstCases, AreNotExceededByAnyCombination) {
  expect_worst_of_all(nominal_iso_2813(), "60",
                      rungs({"white_diffuser", "glass_m020", "copper_m065", "ideal_mirror"}));
}

// The image of the source fills the receptor to within the tolerances, so that readings of a lobe
// have kinks: there the light of the tile is lost.
TEST(WorstCases, AreNotExceededByAnyCombinationWhereTheImageIsClipped) {
  Instrument clipped = nominal_iso_2813();
  for (GeometryLimits& limits : clipped.standard.geometries) {
    limits.source.in_plane->value->nominal = degrees(4.1);
  }
  const std::vector<Sample> ladder = rungs({"glass_m100", "ideal_mirror"});
  expect_worst_of_all(clipped, "60", ladder);
  const OpticalResponse response(clipped, "60", ladder, tolerance_gu);
  const WorstCases found = worst_cases(response, clipped.standard.geometry("60"));
  EXPECT_GT(found.highest[0].change_gu, 0.05 * response(response.nominal())(0));
}

// Figures published for both sides of the receptor at their limits.
TEST(WorstCases, OfTheReceptorAloneAreTheFiguresKnown) {
  constexpr double rounding_gu = 0.01;
  GeometryLimits limits = with_given_source(nominal_iso_2813().standard.geometry("60"));
  limits.theta_i.tolerance.reset();
  limits.theta_r->tolerance.reset();
  const std::vector<Sample> ladder = rungs({"glass_m030", "glass_m050", "glass_m100"});
  const OpticalResponse response(nominal_iso_2813(), "60", ladder, tolerance_gu);
  const WorstCases found = worst_cases(response, limits);
  const std::vector<double> low{62.20, 40.13, 17.57}, nominal_gu{63.30, 41.02, 18.13},
      high{64.38, 41.90, 18.68};
  for (std::size_t s = 0; s < ladder.size(); ++s) {
    EXPECT_TRUE(is_close(found.lowest[s].change_gu, low[s] - nominal_gu[s], rounding_gu));
    EXPECT_TRUE(is_close(found.highest[s].change_gu, high[s] - nominal_gu[s], rounding_gu));
    EXPECT_THAT(found.lowest[s].setup,
                Pointwise(DoubleEq(), std::vector<double>{60, 60, 0.75, 2.5, 4.3, 11.5}));
    EXPECT_THAT(found.highest[s].setup,
                Pointwise(DoubleEq(), std::vector<double>{60, 60, 0.75, 2.5, 4.5, 11.9}));
  }
}

TEST(WorstCases, OfAMirrorLeaveTheReceptorNominal) {
  const std::vector<Sample> mirror = rungs({"ideal_mirror"});
  const OpticalResponse response(nominal_iso_2813(), "60", mirror, tolerance_gu);
  const WorstCases found =
      worst_cases(response, with_given_source(nominal_iso_2813().standard.geometry("60")));
  const auto gloss = [](double theta_deg) {
    return 100.0 / test::glass_reflectance(theta_deg, 1.567);
  };
  constexpr double of_the_source_gu = 0.005;  // which Fresnel's formula is averaged over
  const auto expect = [&](const WorstCase& worst, double theta_deg) {
    EXPECT_TRUE(is_close(worst.change_gu, gloss(theta_deg) - gloss(60), of_the_source_gu));
    EXPECT_DOUBLE_EQ(worst.setup[0], theta_deg);
    EXPECT_EQ(worst.setup[1], response.nominal()(1));
    EXPECT_EQ(worst.setup[4], response.nominal()(4));
    EXPECT_EQ(worst.setup[5], response.nominal()(5));
  };
  expect(found.lowest.front(), 60.1);
  expect(found.highest.front(), 59.9);
}

TEST(WorstCases, WithoutTolerancesAreNone) {
  GeometryLimits limits = nominal_iso_2813().standard.geometry("60");
  limits.theta_i.tolerance.reset();
  limits.theta_r.reset();
  limits.source = {};
  limits.receptor = {};
  const std::vector<Sample> rough = rungs({"glass_m050"});
  const OpticalResponse response(nominal_iso_2813(), "60", rough, tolerance_gu);
  const WorstCases found = worst_cases(response, limits);
  for (const WorstCase& worst : {found.lowest.front(), found.highest.front()}) {
    EXPECT_EQ(worst.change_gu, 0.0);
    EXPECT_EQ(worst.setup,
              (std::vector<double>(response.nominal().begin(), response.nominal().begin() + 6)));
  }
}

}  // namespace
}  // namespace gonio

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/signal.hpp"
#include "emulator/procedure/setup_estimator.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/tile_set.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::is_close;
using test::quick_tiles;
using test::TileSet;

// How often the stated intervals hold.

constexpr std::size_t trials = test::trials(500);
constexpr std::uint64_t seed_of_setups = 77;
constexpr std::uint64_t seed_of_noise = 78;
constexpr double deviates_of_95_percent = 1.96;
/// Left to chance, of 500 trials 2.4 %: 92.6 to 97.4 %.
constexpr double standard_deviations = 2.5;

/// What came of a simulated instrument.
struct Trial {
  VectorXd error;      // of the estimates, in stated uncertainties
  double joint = 0.0;  // chi squared of the errors with their covariance
  double chi_squared = 0.0;
  bool has_converged = false;
};

VectorXd deviates(Index n, std::uint64_t seed, std::size_t trial) {
  VectorXd values(n);
  for (Index i = 0; i < n; ++i) {
    values(i) = normal_noise(seed, std::size_t(i), trial);
  }
  return values;
}

/// Set-ups drawn from the priors, readings drawn from their uncertainties.
std::vector<Trial> trials_of(const TileSet& set, std::size_t n) {
  std::vector<Trial> result(n);
  parallel_for(n, [&](std::size_t k) {
    const VectorXd planted = set.setup(deviates(set.parameters(), seed_of_setups, k));
    const VectorXd noise = set.u_gu() * deviates(set.size(), seed_of_noise, k);
    const SetupEstimate found = set.estimate(set.estimator().reading(planted) + noise);
    const Index p = set.parameters();
    VectorXd error(p);
    MatrixXd correlation(p, p);
    for (Index i = 0; i < p; ++i) {
      const EstimatedParameter& one = found.parameters[std::size_t(i)];
      error(i) = (one.estimate - planted(i)) / one.standard_uncertainty;
      for (Index j = 0; j < p; ++j) {
        correlation(i, j) = found.correlation[std::size_t(i)][std::size_t(j)];
      }
    }
    result[k] = {.error = error,
                 .joint = error.dot(correlation.ldlt().solve(error)),
                 .chi_squared = found.chi_squared,
                 .has_converged = found.has_converged};
  });
  return result;
}

class Coverage : public testing::TestWithParam<const char*> {};

/// The intervals rest on derivatives at the estimate: deviations are drawn of one tolerance, for
/// over three the readings bend too much for them.
TEST_P(Coverage, IsThatOfTheStatedIntervals) {
  const TileSet set(GetParam(), quick_tiles(GetParam()), 0.2,
                    {.prior_tolerances = 1.0, .tolerance = 1e-3});
  const std::vector<Trial> found = trials_of(set, trials);
  for (Index i = 0; i < set.parameters(); ++i) {
    const auto covered = std::ranges::count_if(found, [&](const Trial& trial) {
      return std::abs(trial.error(i)) < deviates_of_95_percent;
    });
    const double share = double(covered) / double(trials);
    EXPECT_NEAR(share, 0.95, test::chance_about_95_percent(trials, standard_deviations))
        << set.estimator().parameters()[std::size_t(i)].name;
  }
  EXPECT_TRUE(std::ranges::all_of(found, &Trial::has_converged));
}

INSTANTIATE_TEST_SUITE_P(At, Coverage, testing::Values("20", "60", "85"),
                         [](const auto& geometry) { return std::string(geometry.param); });

TEST(SetupEstimate, HasErrorsThatGoTogetherAsItsCorrelationSays) {
  // Sums of chi squared over the trials, within 3 standard deviations, sqrt(2 n) of n degrees of
  // freedom. Deviations are drawn of a fifth of a tolerance: what is known of some combination to a
  // hundredth of what is known of others shows every bend.
  constexpr std::size_t n = test::trials(300);
  const TileSet set("60", quick_tiles("60"), 0.2, {.prior_tolerances = 0.2, .tolerance = 1e-3});
  double joint = 0.0;
  double chi_squared = 0.0;
  for (const Trial& trial : trials_of(set, n)) {
    joint += trial.joint;
    chi_squared += trial.chi_squared;
  }
  const double of_errors = double(n) * double(set.parameters());
  const double of_readings = double(n) * double(set.size());
  EXPECT_TRUE(is_close(joint, of_errors, 3.0 * std::sqrt(2.0 * of_errors)));
  EXPECT_TRUE(is_close(chi_squared, of_readings, 3.0 * std::sqrt(2.0 * of_readings)));
}

}  // namespace
}  // namespace gonio

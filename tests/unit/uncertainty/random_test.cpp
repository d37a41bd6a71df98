#include "emulator/uncertainty/random.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "emulator/uncertainty/distribution.hpp"
#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

using test::is_close;

constexpr std::uint64_t seed = 20261122;
constexpr Eigen::Index count = 200'000;
constexpr double five_sigma = 5.0;  // a right generator fails once in two million

std::vector<double> uniform(std::uint64_t of_seed, std::uint64_t trial, std::size_t n) {
  std::vector<double> values(n);
  Draws(of_seed, trial).uniform(values);
  return values;
}

TEST(Draws, AreThoseOfPhilox) {
  // Known answer of Random123 for philox4x64-10 with counter and key 0.
  const std::array<std::uint64_t, 4> known{0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                           0xd7e772cee186176b, 0x7e68b68aec7ba23b};
  const std::vector<double> drawn = uniform(0, 0, 4);
  for (std::size_t i = 0; i < known.size(); ++i) {
    constexpr double one_step = 0x1p-52;
    EXPECT_TRUE(is_close(drawn[i], double(known[i]) * 0x1p-64, one_step));
  }
}

TEST(Draws, DoNotDependOnHowManyAreAskedFor) {
  const std::vector<double> many = uniform(seed, 17, 45);
  for (const std::size_t n : {1U, 3U, 4U, 5U, 44U}) {
    const std::vector<double> few = uniform(seed, 17, n);
    EXPECT_EQ(few, std::vector<double>(many.begin(), many.begin() + std::ptrdiff_t(n)));
  }
}

TEST(Draws, DifferWithSeedTrialAndStream) {
  const std::vector<double> some = uniform(seed, 17, 8);
  std::vector<double> others(8);
  Draws(seed, 17, 1).uniform(others);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_NE(some[i], uniform(seed + 1, 17, 8)[i]);
    EXPECT_NE(some[i], uniform(seed, 18, 8)[i]);
    EXPECT_NE(some[i], others[i]);
  }
}

TEST(Draws, OfManyTrialsAreThoseOfEachTrial) {
  Eigen::ArrayXXd block(13, 10);
  uniform_draws(seed, 0, 1000, block);
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    const std::vector<double> trial = uniform(seed, 1000 + std::uint64_t(i), 10);
    for (Eigen::Index j = 0; j < block.cols(); ++j) {
      EXPECT_EQ(block(i, j), trial[std::size_t(j)]);
    }
  }
  std::vector<double> seventh(13);
  uniform_draws_of(7, seed, 0, 1000, seventh);
  EXPECT_TRUE((block.col(7) == Eigen::Map<Eigen::ArrayXd>(seventh.data(), 13)).all());
}

TEST(Draws, OfANormalDistributionAreItsQuantilesAtTheUniformOnes) {
  const std::vector<double> p = uniform(seed, 3, 40);
  std::vector<double> z(40);
  Draws(seed, 3).normal(z);
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_TRUE(is_close(z[i], quantile({.standard_uncertainty = 1.0}, p[i]), 1e-14));
  }
}

TEST(Draws, AreUniformInEqualBins) {
  constexpr std::size_t n_bins = 100;
  Eigen::ArrayXXd p(count, 4);
  uniform_draws(seed, 0, 0, p);
  EXPECT_GT(p.minCoeff(), 0.0);
  EXPECT_LT(p.maxCoeff(), 1.0);
  for (Eigen::Index j = 0; j < p.cols(); ++j) {
    std::array<double, n_bins> found{};
    for (Eigen::Index i = 0; i < count; ++i) {
      ++found[std::size_t(p(i, j) * double(n_bins))];
    }
    const double expected = double(count) / double(n_bins);
    double chi_squared = 0.0;
    for (const double in_bin : found) {
      chi_squared += (in_bin - expected) * (in_bin - expected) / expected;
    }
    constexpr double nu = double(n_bins - 1);
    EXPECT_TRUE(is_close(chi_squared, nu, five_sigma * std::sqrt(2.0 * nu)));
  }
}

TEST(Draws, OfOneTrialAndOfTrialsInARowAreNotCorrelated) {
  Eigen::ArrayXXd p(count, 6);
  uniform_draws(seed, 0, 0, p);
  const Eigen::ArrayXXd z = (p - 0.5) * std::sqrt(12.0);
  const double sigma = 1.0 / std::sqrt(double(count));
  for (Eigen::Index a = 0; a < p.cols(); ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      EXPECT_TRUE(is_close((z.col(a) * z.col(b)).mean(), 0.0, five_sigma * sigma));
    }
    EXPECT_TRUE(is_close((z.col(a).head(count - 1) * z.col(a).tail(count - 1)).mean(), 0.0,
                         five_sigma * sigma));
  }
}

}  // namespace
}  // namespace gonio

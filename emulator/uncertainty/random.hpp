#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace gonio {

/// Draws that depend on nothing but the seed, the number of the trial and their own number: however
/// trials are shared out to threads, trial 17 is trial 17. Philox-4x64-10 [Salmon et al., SC 2011].
class Draws {
 public:
  /// @param stream  another one gives other draws of the same trial.
  Draws(std::uint64_t seed, std::uint64_t trial, std::uint64_t stream = 0)
      : seed_(seed), trial_(trial), stream_(stream) {}

  /// In (0, 1).
  void uniform(std::span<double> values) const;
  /// Of mean 0 and standard deviation 1: the quantiles at the uniform draws of the same numbers.
  void normal(std::span<double> values) const;

 private:
  std::uint64_t seed_, trial_, stream_;
};

/// The uniform draws of many trials at once.
/// @param values  result, shape (n_trials, n_draws): draw j of trial first_trial + i at (i, j).
void uniform_draws(std::uint64_t seed, std::uint64_t stream, std::uint64_t first_trial,
                   Eigen::Ref<Eigen::ArrayXXd> values);

/// Draw `number` alone of many trials.
void uniform_draws_of(std::uint64_t number, std::uint64_t seed, std::uint64_t stream,
                      std::uint64_t first_trial, std::span<double> values);

}  // namespace gonio

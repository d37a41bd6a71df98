#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "emulator/uncertainty/input_set.hpp"

namespace gonio {

/// A measurement of several outputs, for many values of its inputs at once. Called from several
/// threads.
/// @param x  values of the inputs, shape (n_trials, n_inputs).
/// @param y  result, shape (n_trials, n_outputs).
using BatchModel = std::function<void(const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y)>;

struct MonteCarloOptions {
  std::uint64_t seed = 1;
  double coverage = 0.95;
  /// So many, rounded up to whole blocks; nothing: until all outputs are stable.
  std::optional<std::size_t> trials = {};
  std::size_t most_trials = 1'000'000;  ///< where that does not come about
  /// Called after each block, one at a time, with the trials done.
  std::function<void(std::size_t)> advance = {};
};

struct MonteCarloOutput {
  double mean = 0.0;
  double standard_uncertainty = 0.0;
  double low = 0.0, high = 0.0;  ///< the probabilistically symmetric coverage interval
  /// Twice the standard deviation of the mean over blocks, of the largest of these four, relative
  /// to half a unit of the second digit of the standard uncertainty: stable if <= 1.
  double instability = 0.0;

  [[nodiscard]] double expanded_uncertainty() const { return 0.5 * (high - low); }
};

struct MonteCarloResult {
  std::vector<MonteCarloOutput> outputs = {};
  std::size_t trials = 0;
  bool is_stable = false;
};

/// Propagates distributions. The same result for any number of threads.
///
/// Blocks of 10^4 trials follow each other until mean, standard uncertainty and both ends of the
/// interval of each output are stable to two digits of the standard uncertainty.
///
/// @throws std::domain_error      if the correlation matrix is not positive definite, or an output
///                                is not finite.
/// @throws std::invalid_argument  for a coverage outside (0, 1).
/// @see    JCGM 101:2008, 7.9
[[nodiscard]] MonteCarloResult monte_carlo(const InputSet& inputs, std::size_t n_outputs,
                                           const BatchModel& model,
                                           const MonteCarloOptions& options);

}  // namespace gonio

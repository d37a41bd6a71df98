#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "emulator/uncertainty/input_set.hpp"

namespace gonio {

/// Values of input quantities by their distributions. Input j of trial i depends on the seed, i and
/// j only, and of another input on those that it is correlated with.
class InputSampler {
 public:
  /// @param inputs  must outlive this object.
  /// @throws std::domain_error  if the correlation matrix is not positive definite.
  InputSampler(const InputSet& inputs, std::uint64_t seed);

  /// May be called from several threads.
  /// @param x  result, shape (n_trials, n_inputs): trials first_trial and following.
  void draw(std::uint64_t first_trial, Eigen::ArrayXXd& x) const;

 private:
  void correlate(Eigen::ArrayXXd& x) const;

  const InputSet& inputs_;
  std::uint64_t seed_;
  std::vector<Eigen::Index> correlated_ = {};  // inputs that are so with any other
  Eigen::MatrixXd cholesky_ = {};              // lower factor of their correlation matrix
};

}  // namespace gonio

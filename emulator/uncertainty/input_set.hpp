#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/uncertainty/distribution.hpp"

namespace gonio {

/// An input quantity of a measurement.
struct InputQuantity {
  std::string id;  ///< e.g. 60/theta_i
  double estimate = 0.0;
  Distribution distribution = {};
};

/// The input quantities of a measurement, and how they are correlated.
class InputSet {
 public:
  /// @return  its place among the inputs.
  std::size_t add(InputQuantity input);
  /// @param coefficient  in [-1, 1].
  /// @throws std::invalid_argument  for an input with itself, or one that is not normal with
  ///                                degrees of freedom without end: what else a correlation would
  ///                                mean, the GUM does not say.
  void correlate(std::size_t a, std::size_t b, double coefficient);

  [[nodiscard]] const std::vector<InputQuantity>& inputs() const { return inputs_; }
  [[nodiscard]] std::size_t size() const { return inputs_.size(); }
  /// Shape (size, size), 1 in the diagonal.
  [[nodiscard]] Eigen::MatrixXd correlation() const;
  /// The smallest eigenvalue of the correlation matrix; 1 if nothing is correlated. What is not
  /// above `positive_definite` contradicts itself.
  [[nodiscard]] double smallest_eigenvalue() const;
  static constexpr double positive_definite = 1e-12;
  /// @throws std::domain_error  with the smallest eigenvalue, if it is not above that.
  void expect_positive_definite() const;

 private:
  struct Pair {
    std::size_t a, b;
    double coefficient;
  };
  std::vector<InputQuantity> inputs_;
  std::vector<Pair> pairs_;
};

}  // namespace gonio

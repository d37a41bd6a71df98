#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "emulator/goniometry/fit_model.hpp"
#include "emulator/goniometry/fit_observations.hpp"

namespace gonio {

/// What the terms of a model respond in a set of observations, whatever was observed.
///
/// Of a term with one shape, responses are computed at steps of its logarithm, an eighth of an
/// octave, as they are asked for, and polynomials of the fifth degree lie between them: smooth for
/// a search, and kept for the next. Others are computed where they are asked for.
class ModelResponses {
 public:
  /// @param n_hat  of the material, on the grid of the observations.
  ModelResponses(const FitObservations& observations, FittableModel model, Eigen::ArrayXcd n_hat);

  [[nodiscard]] const FittableModel& model() const { return model_; }
  /// @param values  at least of the shapes of the model.   @return  shape (n)
  [[nodiscard]] const Eigen::VectorXd& of(std::size_t term, const FitValues& values);

 private:
  using Key = std::pair<std::size_t, std::vector<double>>;

  [[nodiscard]] Eigen::VectorXd computed(std::size_t term, const FitValues& values) const;
  [[nodiscard]] Eigen::VectorXd interpolated(std::size_t term, const FitParameter& shape,
                                             double value);
  const Eigen::VectorXd& node(std::size_t term, const std::string& shape, int step);

  WavelengthGrid grid_;
  std::function<Eigen::VectorXd(const Surface&)> respond_;
  FittableModel model_;
  Eigen::ArrayXcd n_hat_;
  std::map<Key, Eigen::VectorXd> known_;
  std::map<std::pair<std::size_t, int>, Eigen::VectorXd> nodes_;
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/procedure/measurement_equation.hpp"
#include "emulator/procedure/optical_response.hpp"
#include "emulator/procedure/polynomial_surrogate.hpp"
#include "emulator/procedure/uncertainty_inputs.hpp"

namespace gonio {

/// Readings of samples at one geometry as a function of all inputs: the optics, then the
/// measurement equation.
class ReadingModel {
 public:
  /// @param instrument  as built.
  /// @param set         of which `inputs` tells the places.
  /// @param samples     on one wavelength grid; must outlive this object.
  /// @param tolerance   asked of the integrator, in GU.
  ReadingModel(const Instrument& instrument, const InputSet& set, GeometryInputs inputs,
               const std::vector<Sample>& samples, double tolerance);

  [[nodiscard]] const OpticalResponse& optics() const { return optics_; }
  [[nodiscard]] const MeasurementEquation& equation() const { return equation_; }
  [[nodiscard]] const GeometryInputs& inputs() const { return inputs_; }

  /// @param x  all inputs, shape (set.size()).
  /// @return   GU, shape (n_samples).
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& x) const;
  /// The same where the optics read g, shape (n_samples).
  [[nodiscard]] Eigen::VectorXd of_optics(const Eigen::VectorXd& g, const Eigen::VectorXd& x) const;
  /// With all else as estimated.
  [[nodiscard]] Eigen::VectorXd at_estimates(const Eigen::VectorXd& g) const {
    return of_optics(g, estimates());
  }
  /// Derivatives at the estimates: the optics by differences, the measurement equation by automatic
  /// differentiation. GU per unit of the input, shape (n_samples, set.size()).
  [[nodiscard]] Eigen::MatrixXd jacobian() const;
  /// Half the difference of the readings one standard uncertainty up and down from the estimates,
  /// per unit of the input: what the law of propagation takes for linear.
  [[nodiscard]] Eigen::MatrixXd secants() const;

  /// Fits polynomials to the optics, within four standard uncertainties of the estimates. Samples
  /// for which one errs by 1e-3 GU or more are to be read directly.
  void fit(std::uint64_t seed);
  /// Readings for many values of the inputs, through the polynomials.
  /// @param x  shape (n, set.size()).   @param y  result, shape (n, n_samples).
  void evaluate(const Eigen::ArrayXXd& x, Eigen::Ref<Eigen::ArrayXXd> y) const;
  /// Through the optics themselves. @param y  result, shape (n, direct().size()).
  void evaluate_directly(const Eigen::ArrayXXd& x, Eigen::Ref<Eigen::ArrayXXd> y) const;
  /// Of the polynomials, by sample; and the samples for which that is too much.
  [[nodiscard]] const Eigen::VectorXd& surrogate_error() const { return surrogate_->error(); }
  [[nodiscard]] const std::vector<std::size_t>& direct() const { return direct_; }

 private:
  void of_optics(const Eigen::ArrayXXd& g, const Eigen::ArrayXXd& x,
                 Eigen::Ref<Eigen::ArrayXXd>& y) const;
  [[nodiscard]] const InputQuantity& optical_input(Eigen::Index parameter) const;
  [[nodiscard]] Eigen::VectorXd optical_part(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd estimates() const;

  const InputSet& set_;
  GeometryInputs inputs_;
  const std::vector<Sample>& samples_;
  OpticalResponse optics_;
  MeasurementEquation equation_;
  std::vector<Eigen::Index> optical_index_ = {};  // place of each parameter of the optics in x
  std::optional<PolynomialSurrogate> surrogate_ = {};
  std::vector<std::size_t> direct_ = {};
  std::vector<OpticalResponse> direct_optics_ = {};  // of each direct sample
};

}  // namespace gonio

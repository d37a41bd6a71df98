#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/procedure/measurement_equation.hpp"
#include "emulator/procedure/optical_response.hpp"
#include "emulator/procedure/setup_estimate.hpp"

namespace gonio {

/// Estimates the set-up of one geometry from readings of the same tiles, as often as wanted.
///
/// A reading is that of MeasurementEquation, of reference_value (here relative to the value of the
/// scale), zero, and the linearity of the instrument's behaviour.
class SetupEstimator {
 public:
  /// @param tiles  on one wavelength grid; must outlive this object.
  /// @throws InputError             for an aperture of unknown size that is not stated as built, or
  ///                                a receptor that the reference glass sends no light to.
  /// @throws std::invalid_argument  for no tiles, or a geometry that the instrument has not.
  SetupEstimator(const Instrument& instrument, std::string geometry_id,
                 const std::vector<Sample>& tiles, const SetupEstimateOptions& options);

  /// The parameters before readings: the quantities of the set-up in the order of SetupQuantity,
  /// reference_value, zero.
  [[nodiscard]] const std::vector<EstimatedParameter>& parameters() const { return parameters_; }

  /// What a set-up reads of each tile without noise, in GU, shape (n_tiles); infinite where the
  /// reference glass sends no light to the receptor. May be called from several threads.
  /// @param x  parameters, shape (n_parameters).
  [[nodiscard]] Eigen::VectorXd reading(const Eigen::VectorXd& x) const;
  /// Its derivatives, shape (n_tiles, n_parameters).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;

  /// May be called from several threads.
  /// @param tile_of  for each reading, its place among the tiles.
  /// @throws InputError             for a reading whose uncertainty nobody states.
  /// @throws std::invalid_argument  for a place that there is not.
  [[nodiscard]] SetupEstimate estimate(const std::vector<TileReading>& readings,
                                       const std::vector<std::size_t>& tile_of) const;

 private:
  [[nodiscard]] Eigen::VectorXd optics(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::MatrixXd optics_jacobian(const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& here) const;
  [[nodiscard]] MeasurementEquation::Components<double> components(const Eigen::VectorXd& x) const;
  [[nodiscard]] PriorFitProblem problem(const std::vector<TileReading>& readings,
                                        const std::vector<std::size_t>& tile_of) const;

  OpticalResponse response_;
  std::string geometry_id_;
  Behaviour behaviour_;
  MeasurementEquation equation_;
  std::vector<EstimatedParameter> parameters_;
  Eigen::VectorXd assumed_, prior_;  // of the parameters
  Eigen::MatrixXd jacobian_assumed_;
};

}  // namespace gonio

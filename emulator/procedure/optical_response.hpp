#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "emulator/instrument/setup.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// What the optics of one geometry read of samples, as a function of its set-up, with the reference
/// glass read through the same set-up. Neither noise nor anything of the detector.
///
/// Parameters are the quantities of the set-up in degrees, the polarization P of `polarised`, and
/// the spectral mismatch s, which makes source times responsivity
///
///   1 + s (lambda - 560 nm) / 100 nm
///
/// times as much. Where the reference is read in another geometry, that one stays as built. An
/// opening of -w has the edges of w swapped and is taken for w, so that what is sampled round a
/// small opening has a meaning, and a derivative at an opening of 0 is 0.
class OpticalResponse {
 public:
  /// @param instrument  as built; spectra as built.
  /// @param samples     on one wavelength grid; must outlive this object.
  /// @param tolerance   asked of the integrator, in GU.
  /// @throws InputError             for an aperture of unknown size that is not stated as built.
  /// @throws std::invalid_argument  for no samples, or a geometry that the instrument has not.
  OpticalResponse(Instrument instrument, std::string geometry_id,
                  const std::vector<Sample>& samples, double tolerance);

  /// The quantities of the set-up, those that this geometry has, in the order of SetupQuantity.
  [[nodiscard]] const std::vector<SetupQuantity>& quantities() const { return quantities_; }
  /// Number of parameters: the quantities, polarization, spectral_mismatch, in this order.
  [[nodiscard]] Eigen::Index size() const { return Eigen::Index(quantities_.size()) + 2; }
  /// Number of samples.
  [[nodiscard]] Eigen::Index samples() const { return Eigen::Index(samples_.size()); }
  /// As built. Angles in degrees; spectral_mismatch is 0. Shape (size).
  [[nodiscard]] const Eigen::VectorXd& as_built() const { return as_built_; }
  /// As the standard says; as built where it says nothing. Polarization 0. Shape (size).
  [[nodiscard]] const Eigen::VectorXd& nominal() const { return nominal_; }

  /// Gloss of each sample, GU, shape (n_samples). May be called from several threads.
  /// @throws std::domain_error  for parameters that are not as many, an angle outside (-90, 90)
  ///                            deg, an opening beyond 120 deg, P outside [-1, 1], or an s that
  ///                            leaves no weight or less to a wavelength.
  /// @throws InputError         for a receptor that the reference glass sends no light to.
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& parameters) const;
  /// The same with the spectra that the standard asks for in place of the instrument's.
  [[nodiscard]] Eigen::VectorXd with_standard_spectra(const Eigen::VectorXd& parameters) const;

  /// Derivatives of each sample's gloss at these parameters by central differences, extrapolated to
  /// vanishing steps: what an adaptive integral over moving edges allows. Of all steps and orders
  /// the one with the smallest error is taken, by sample: rounding spoils small steps, and a tile
  /// whose image is clipped near by spoils large ones. The integrator's error is alike at both ends
  /// of a step.
  /// @param steps  first steps, > 0, shape (size); 0 leaves out a parameter, its derivative is 0.
  ///               Those below 0.05 deg, or 0.01 for the last two, are made larger.
  /// @return       GU per unit of the parameter, shape (n_samples, size).
  /// @throws std::domain_error  as above.
  /// @see    Ridders, Advances in Engineering Software 4, 75 (1982)
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& parameters,
                                         const Eigen::VectorXd& steps) const;

  /// The same for one of the samples alone, for a coarser or a finer integrator.
  [[nodiscard]] OpticalResponse of_sample(std::size_t i) const;
  [[nodiscard]] OpticalResponse with_tolerance(double tolerance) const;

 private:
  [[nodiscard]] Instrument with_parameters(const Instrument& instrument,
                                           const Eigen::VectorXd& parameters) const;
  [[nodiscard]] Eigen::VectorXd read(const Instrument& instrument) const;
  [[nodiscard]] double step(Eigen::Index parameter, double value, double wanted) const;

  Instrument instrument_, with_standard_spectra_;
  std::string geometry_id_;
  std::span<const Sample> samples_;
  double tolerance_;
  std::vector<SetupQuantity> quantities_;
  Eigen::VectorXd as_built_, nominal_;
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>

#include "emulator/integration/aperture.hpp"
#include "emulator/integration/cubature.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// What is integrated over both apertures: several functions f_k(omega_i, omega_r) at once, of
/// which the flux at each wavelength is a sum, and what is wanted of them.
class Integrand {
 public:
  /// @param spectra  what a unit of each function adds to the flux, shape (n_k, n_lambda); must
  ///                 outlive this object.
  /// @param weight   of wavelengths, as for FluxIntegrator.
  Integrand(const Eigen::MatrixXd& spectra, const Eigen::ArrayXd& weight)
      : functional_(spectra * weight.matrix()) {}
  virtual ~Integrand() = default;
  Integrand(const Integrand&) = delete;
  Integrand& operator=(const Integrand&) = delete;
  Integrand(Integrand&&) = delete;
  Integrand& operator=(Integrand&&) = delete;

  /// The sum over k whose error is controlled: the weighted flux. Shape (n_k).
  [[nodiscard]] const Eigen::VectorXd& functional() const { return functional_; }
  /// How wide the peak round the mirror direction is; panels are graded towards it.
  [[nodiscard]] virtual SlopeWidth slope_width(double cos_theta_i) const = 0;
  /// The same for a pair of directions as for that pair with both y reversed.
  [[nodiscard]] virtual bool is_symmetric() const = 0;

  /// Takes the functions at these directions.
  virtual void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r) = 0;
  /// The functional of what was evaluated last, shape (n).
  virtual void control(Eigen::ArrayXd& value) = 0;
  /// sum(k) += sum_j weight(j) f_k(j) of what was evaluated last. @param weight  (n); is
  /// overwritten.
  virtual void add(Eigen::ArrayXd& weight, Eigen::Ref<Eigen::VectorXd> sum) = 0;

 private:
  Eigen::VectorXd functional_;
};

/// int_source cos i d omega_i int_receptor f_k cos r d omega_r.
///
/// @param tolerance  on the error of the functional [sr].
/// @param incident   what falls on the sample, > 0 [sr].
/// @param budget     of cells, lessened by each; where to give up.
[[nodiscard]] Integral nested_integral(Integrand& integrand, const MeasuringGeometry& geometry,
                                       double tolerance, double incident, std::size_t& budget);

}  // namespace gonio

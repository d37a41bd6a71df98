#pragma once

#include <Eigen/Core>
#include <array>

#include "emulator/integration/aperture.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// Radiant flux of eq. (16), per unit radiance of the source and unit area of the sample.
struct Flux {
  Eigen::ArrayXd spectral;  ///< [sr], shape (n_lambda)
  double error = 0.0;       ///< bound on the error of sum(weight * spectral) [sr]
};

/// Integrates what a surface reflects from a source aperture into a receptor aperture.
///
///   Phi(lambda) = int_source cos i d omega_i int_receptor f_r(lambda) cos r d omega_r
///
/// `weight` is what the measurement weighs wavelengths with (not negative, sum 1, shape
/// (n_lambda)); an integrator controls the error of the flux weighted so, to `tolerance` [sr].
/// Where the source has no extent in an axis, the integral over that axis is the integrand.
/// @see [Mihalik] eq. (16), (17), where the inner sum's detector index runs as j, l and r: read one
class FluxIntegrator {
 public:
  virtual ~FluxIntegrator() = default;

  [[nodiscard]] virtual Flux reflected(const Surface& surface, const MeasuringGeometry& geometry,
                                       const Eigen::ArrayXd& weight, double tolerance) const = 0;
  /// What falls on the sample: int_source cos i d omega_i [sr].
  [[nodiscard]] virtual double incident(const Aperture& source) const = 0;
  /// Reflectance into the whole hemisphere for light from omega_i; `spectral` and `error` are
  /// dimensionless, and so is the tolerance. @see [Mihalik] eq. (7)
  [[nodiscard]] virtual Flux hemispherical(const Surface& surface, const Vector3& omega_i,
                                           const Eigen::ArrayXd& weight,
                                           double tolerance) const = 0;
};

/// The smallest and the largest cosine of the angle d between a direction of the source and one of
/// the receptor, or bounds on them.
struct CosineRange {
  double low, high;
};
[[nodiscard]] CosineRange half_angle_range(const MeasuringGeometry& geometry);

/// The five faces of the cube of half size 1 round the sample, above its plane.
[[nodiscard]] std::array<Aperture, 5> hemicube_faces();

/// An aperture without extent: light from one direction.
[[nodiscard]] Aperture collimated(const Vector3& omega);

}  // namespace gonio

#pragma once

#include "emulator/integration/chebyshev.hpp"
#include "emulator/integration/cubature.hpp"
#include "emulator/integration/flux.hpp"

namespace gonio {

/// The flux of one lobe from a source aperture into a receptor aperture.
///
/// The geometry is integrated once, as moments in Chebyshev polynomials of cos theta_d; the colour
/// of the lobe makes fluxes of all wavelengths from them. Where the shape follows a parameter that
/// changes with wavelength, moments are interpolated between Chebyshev points of the parameter.
class LobeFlux {
 public:
  /// @param weight     of wavelengths, as for FluxIntegrator; must outlive this object.
  /// @param tolerance  on the error of the weighted flux [sr].
  /// @param incident   what falls on the sample, > 0 [sr].
  LobeFlux(const Lobe& lobe, const MeasuringGeometry& geometry, const Eigen::ArrayXd& weight,
           double tolerance, double incident);

  [[nodiscard]] Flux operator()() const;

 private:
  [[nodiscard]] Integral moments(double parameter, double tolerance) const;
  [[nodiscard]] Flux with_fixed_shape(double parameter) const;
  [[nodiscard]] Flux with_changing_shape() const;

  const Lobe& lobe_;
  const MeasuringGeometry& geometry_;
  const Eigen::ArrayXd& weight_;
  double tolerance_;
  double incident_;
  ColourSeries series_;
  Eigen::VectorXd functional_;  // of the moments, whose error is controlled: the weighted flux
};

}  // namespace gonio

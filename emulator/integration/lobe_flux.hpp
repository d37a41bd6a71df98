#pragma once

#include "emulator/integration/chebyshev.hpp"
#include "emulator/integration/flux.hpp"
#include "emulator/integration/nested_integral.hpp"

namespace gonio {

/// The geometry of a lobe times Chebyshev polynomials of cos theta_d: f_k = g T_k.
class LobeIntegrand : public Integrand {
 public:
  /// All but the weight must outlive this object.
  LobeIntegrand(const Lobe& lobe, double parameter, const ColourSeries& series,
                const Eigen::ArrayXd& weight)
      : Integrand(series.coefficient, weight),
        lobe_(lobe),
        parameter_(parameter),
        series_(series) {}

  [[nodiscard]] SlopeWidth slope_width(double cos_theta_i) const override {
    return lobe_.shape->slope_width(parameter_, cos_theta_i);
  }
  [[nodiscard]] bool is_symmetric() const override { return true; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r) override;
  void control(Eigen::ArrayXd& value) override;
  void add(Eigen::ArrayXd& weight, Eigen::Ref<Eigen::VectorXd> sum) override;

 private:
  const Lobe& lobe_;
  double parameter_;
  const ColourSeries& series_;
  Eigen::ArrayXd x_, g_;
};

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
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/integration/flux.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// What an ideal instrument of these apertures reads: no noise, no drift, a linear detector.
struct GlossReading {
  double gloss = 0.0;                 ///< in the unit of the scale
  double quadrature_error = 0.0;      ///< of the integrator, in the same unit
  double luminous_reflectance = 0.0;  ///< share of the luminous flux that reaches the receptor
  Eigen::ArrayXd reflectance = {};    ///< the same for each wavelength, shape (n_lambda)
};

/// Reads surfaces by a standard's scale.
///
///   G = value * (Phi_sample) / (Phi_reference)
///
/// with both fluxes through the same apertures, weighted by source times responsivity, of surfaces
/// as an instrument of its polarization sees them. The
/// reference is a smooth glass of the standard's index at all wavelengths, unless another one is
/// given, or the incident flux, as the scale says. @see [Mihalik] eq. (16), (17)
class Glossmeter {
 public:
  /// @param reference_index  of a reference glass, shape (n_lambda); empty for the standard's
  ///                         constant.
  /// @throws std::invalid_argument  if the instrument measures colour.
  Glossmeter(Instrument instrument, const WavelengthGrid& grid,
             std::shared_ptr<const FluxIntegrator> integrator,
             const Eigen::ArrayXcd& reference_index = {});

  /// @param tolerance  asked of the integrator, in the unit of the scale, > 0.
  /// @param tilt       of the sample in the plane of measurement, towards the receptor.
  /// @throws InputError  for an aperture of unknown size, or one that the reference does not reach.
  [[nodiscard]] GlossReading read(const Surface& surface, const std::string& geometry_id,
                                  double tolerance, Angle tilt = {}) const;

  [[nodiscard]] const Instrument& instrument() const { return instrument_; }
  [[nodiscard]] const WavelengthGrid& grid() const { return grid_; }
  /// Spectral power of the source on the grid, shape (n_lambda).
  [[nodiscard]] const Eigen::ArrayXd& source() const { return source_; }
  /// Source times responsivity, of sum 1, shape (n_lambda).
  [[nodiscard]] const Eigen::ArrayXd& weight() const { return weight_; }

 private:
  [[nodiscard]] Flux reflected(const Surface& surface, const std::string& geometry_id,
                               const MeasuringGeometry& geometry, double tolerance) const;
  [[nodiscard]] Flux reference_flux(const std::string& geometry_id) const;

  Instrument instrument_;
  WavelengthGrid grid_;
  std::shared_ptr<const FluxIntegrator> integrator_;
  Eigen::ArrayXd source_;
  Eigen::ArrayXd weight_;
  std::optional<Surface> reference_;  // none where the scale is relative to the incident flux
};

/// The value of a polished glass of refractive index n on a scale,
///
///   G(n) = value * rho(n, theta_i) / rho(n_reference, theta_i),
///
/// or value * rho(n, theta_i) on a scale relative to the incident flux.
///
/// @param n  > 0.
/// @throws std::domain_error  if n is outside its range.
/// @see    ISO 2813, ASTM D523: Fresnel's formula for unpolarised light
[[nodiscard]] double assigned_gloss(double n, Angle theta_i, const Scale& scale);

}  // namespace gonio

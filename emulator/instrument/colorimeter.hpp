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

/// What an ideal colorimeter reads of a surface.
struct ColourReading {
  Eigen::ArrayXd radiance_factor = {};  ///< shape (n_lambda); of a mirror it may well exceed 1
  double quadrature_error = 0.0;        ///< of its mean, weighted as the colorimeter was told to
};

/// Reads surfaces against the perfect reflecting diffuser, through the same apertures:
///
///   beta(lambda) = Phi_sample(lambda) / Phi_diffuser(lambda).
///
/// A sphere collects the hemisphere, but for its gloss trap. Its beam is a few directions of equal
/// weight per solid angle; nothing that it collects comes back to the sample.
/// @see CIE S 017, radiance factor and reflectance factor; [Mihalik] section 9
class Colorimeter {
 public:
  /// @param weight  what the accuracy is asked for: not negative, sum 1, shape (n_lambda).
  /// @throws std::invalid_argument  if the instrument measures gloss.
  Colorimeter(Instrument instrument, const WavelengthGrid& grid,
              std::shared_ptr<const FluxIntegrator> integrator, Eigen::ArrayXd weight);

  /// @param tolerance  of the weighted mean of the radiance factor, > 0.
  /// @param tilt       of the sample in the plane of measurement, towards the receptor.
  /// @throws InputError  for an aperture of unknown size, or one that sees no light of a diffuser.
  [[nodiscard]] ColourReading read(const Surface& surface, const std::string& geometry_id,
                                   double tolerance, Angle tilt = {}) const;

  [[nodiscard]] const Instrument& instrument() const { return instrument_; }
  [[nodiscard]] const WavelengthGrid& grid() const { return grid_; }

 private:
  [[nodiscard]] Flux collected(const Surface& surface, const std::string& geometry_id,
                               const MeasuringGeometry& geometry, double tolerance) const;

  Instrument instrument_;
  WavelengthGrid grid_;
  std::shared_ptr<const FluxIntegrator> integrator_;
  Eigen::ArrayXd weight_;
  Surface diffuser_;
};

/// The angle of a receptor from the mirror direction, positive towards the normal and past it.
/// Nothing for a sphere.
[[nodiscard]] std::optional<Angle> aspecular_angle(const GeometryLimits& limits);

}  // namespace gonio

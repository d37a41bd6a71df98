#pragma once

#include <Eigen/Core>
#include <array>
#include <stdexcept>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"

namespace gonio::test {

/// One wavelength, where a test needs no spectrum, and its weight.
inline const WavelengthGrid one_wavelength(nanometres(555), nanometres(1), 1);
inline const Eigen::ArrayXd whole_weight = Eigen::ArrayXd::Ones(1);

inline Eigen::ArrayXcd constant_index(std::complex<double> n_hat,
                                      const WavelengthGrid& grid = one_wavelength) {
  return Eigen::ArrayXcd::Constant(grid.size(), n_hat);
}

/// An index at which Fresnel's reflectance is 1 to rounding at every angle.
inline const std::complex<double> ideal_metal(1e-9, 1e9);

/// A receptor of ISO 2813; full angles.
struct ReceptorSize {
  double theta_deg, in_plane_deg, perpendicular_deg;
};
constexpr std::array<ReceptorSize, 3> iso_receptors{
    {{20.0, 1.8, 3.6}, {60.0, 4.4, 11.7}, {85.0, 4.0, 6.0}}};
/// The source image of ISO 2813; full angles.
constexpr double source_in_plane_deg = 0.75;
constexpr double source_perpendicular_deg = 2.5;

inline Aperture receptor_of(const ReceptorSize& size) {
  return Aperture::rectangle(receptor_frame(degrees(size.theta_deg)), degrees(size.in_plane_deg),
                             degrees(size.perpendicular_deg));
}

inline Aperture source_image(double theta_deg, double in_plane_deg = source_in_plane_deg,
                             double perpendicular_deg = source_perpendicular_deg) {
  return Aperture::rectangle(source_frame(degrees(theta_deg)), degrees(in_plane_deg),
                             degrees(perpendicular_deg));
}

inline Aperture collimated_source(double theta_deg) {
  return collimated(source_frame(degrees(theta_deg)).axis);
}

inline const ReceptorSize& iso_receptor(double theta_deg) {
  for (const ReceptorSize& size : iso_receptors) {
    if (size.theta_deg == theta_deg) {
      return size;
    }
  }
  throw std::invalid_argument("no receptor of ISO 2813");
}

/// The glossmeter of ISO 2813 with its source image, and with a collimated source.
inline MeasuringGeometry glossmeter(double theta_deg) {
  return {source_image(theta_deg), receptor_of(iso_receptor(theta_deg))};
}
inline MeasuringGeometry collimated_glossmeter(double theta_deg) {
  return {collimated_source(theta_deg), receptor_of(iso_receptor(theta_deg))};
}

inline double flux_of(const Surface& surface, const MeasuringGeometry& geometry, double tolerance) {
  return ApertureIntegrator().reflected(surface, geometry, whole_weight, tolerance).spectral(0);
}

/// Flux of the polished glass of index 1.567 that defines 100 GU, in the same geometry [sr].
inline double standard_flux(const MeasuringGeometry& geometry) {
  constexpr double tolerance = 1e-15;
  return flux_of(smooth(one_wavelength, constant_index(1.567)), geometry, tolerance);
}

/// Gloss of a surface on one_wavelength [GU].
inline double gloss_gu(const Surface& surface, const MeasuringGeometry& geometry,
                       double tolerance_gu = 1e-6) {
  const double standard = standard_flux(geometry);
  return 100.0 * flux_of(surface, geometry, 0.01 * tolerance_gu * standard) / standard;
}

}  // namespace gonio::test

#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "emulator/surface/models.hpp"
#include "tests/unit/integration/glossmeter.hpp"

namespace gonio::test {

struct NamedSurface {
  std::string name;
  Surface surface;
};

/// A direction above the surface, its cosine uniform from `least_cosine` on.
inline Vector3 random_direction(std::mt19937& random, double least_cosine = 0.0) {
  std::uniform_real_distribution<double> cosine(least_cosine, 1.0);
  std::uniform_real_distribution<double> azimuth(0.0, 2.0 * std::numbers::pi);
  const double c = cosine(random);
  const double s = std::sqrt(1.0 - c * c);
  const double phi = azimuth(random);
  return {s * std::cos(phi), s * std::sin(phi), c};
}

/// Two wavelengths, so that a spectrum may have a colour.
inline const WavelengthGrid two_wavelengths(nanometres(450), nanometres(200), 2);

/// One surface of each model and variant, of middling roughness, on two_wavelengths.
inline std::vector<NamedSurface> every_model() {
  const WavelengthGrid& grid = two_wavelengths;
  Eigen::ArrayXcd metal(2);
  metal << std::complex<double>(1.15, 2.5), std::complex<double>(0.2, 3.7);
  Eigen::ArrayXcd glass(2);
  glass << 1.58, 1.56;
  Eigen::ArrayXd colour(2);
  colour << 0.3, 0.5;
  const Amplitudes both{.specular = 0.4, .diffuse = colour};
  std::vector<NamedSurface> all = {
      {"lambertian", lambertian(grid, colour)},
      {"cook_torrance", cook_torrance(grid, 0.2, metal, both)},
      {"cook_torrance as printed",
       cook_torrance(grid, 0.2, metal, both, Normalization::as_printed)},
      {"ggx height_correlated", ggx(grid, 0.3, metal, both)},
      {"ggx separable", ggx(grid, 0.3, metal, both, Masking::separable)},
      {"ward", ward(grid, 0.25, 0.25, both)},
      {"ward of two slopes", ward(grid, 0.1, 0.4, both)},
      {"coherent_roughness", coherent_roughness(grid, nanometres(120), micrometres(1.5), metal)},
      {"coated smooth", coated(grid, colour, glass.real(), 0.0)},
      {"coated rough", coated(grid, colour, glass.real(), 0.2)}};
  all.push_back(
      {"mixture", mixture({all[1].surface, all[6].surface, all[8].surface}, {0.2, 0.3, 0.4})});
  return all;
}

/// int f_r cos over the hemisphere at one wavelength, and its error.
struct Reflectance {
  double value, error;
};
inline Reflectance hemispherical_reflectance(const Surface& surface, double theta_i_deg,
                                             double tolerance) {
  const Vector3 omega_i = source_frame(degrees(theta_i_deg)).axis;
  const Flux flux = ApertureIntegrator().hemispherical(surface, omega_i, whole_weight, tolerance);
  return {flux.spectral(0), flux.error};
}

}  // namespace gonio::test

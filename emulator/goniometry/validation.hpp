#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/goniometry/validation_plan.hpp"

namespace gonio {

/// By how much a spectrum differs from a reference r.
struct SpectralDeviation {
  double ratio = 0.0;          ///< mean(v) / mean(r)
  double relative_rmse = 0.0;  ///< sqrt(mean((v - r)^2)) / mean(r)
  /// The same once v is scaled by the factor that brings it nearest: what differs in shape alone.
  double shape_rmse = 0.0;
};

/// @param value, reference  shape (n), n >= 1; the mean of the reference is > 0.
/// @throws std::invalid_argument  if not so.
[[nodiscard]] SpectralDeviation spectral_deviation(const Eigen::ArrayXd& value,
                                                   const Eigen::ArrayXd& reference);

/// What reflects: a smooth surface, or the facets of Cook-Torrance in either normalization.
enum class ValidationModel { smooth, energy_conserving, as_printed };
enum class ValidationIntegrator { aperture, patches };

/// A spectrum that the virtual instrument records, relative to a perfect mirror.
struct SimulatedSpectrum {
  ValidationModel model;
  ValidationIntegrator integrator;
  Eigen::ArrayXd reflectance = {};   ///< shape (n_lambda)
  SpectralDeviation deviation = {};  ///< from the exact reflectance
};

/// One geometry of one material with one refractive index.
struct ValidationGeometry {
  std::string id;
  Angle theta_i;              ///< as built
  Eigen::ArrayXd exact = {};  ///< Fresnel's reflectance at theta_i, shape (n_lambda)
  std::vector<SimulatedSpectrum> simulated = {};
  /// The slope at which eq. (15) as printed reads as much as the exact reflectance, in the mean;
  /// nothing if none does.
  std::optional<double> matching_slope = {};
};

struct ValidationAuthor {
  std::string author;
  std::vector<ValidationGeometry> geometries = {};  ///< in the instrument's order
};

/// The patch method at one resolution.
struct ConvergencePoint {
  int resolution = 0;  ///< N, of 3 N^2 patches
  /// Mean reflectance against that of the aperture integrator, less 1; by geometry. NaN
  /// where no patch lies within the source.
  std::vector<double> difference = {};
};

struct MaterialValidation {
  std::vector<ValidationAuthor> authors = {};
  std::vector<ConvergencePoint> convergence = {};  ///< energy conserving, of the first author
};

/// What became of a plan; materials and authors in its order.
struct ValidationResult {
  WavelengthGrid grid = WavelengthGrid::visible();
  std::vector<std::string> geometries = {};
  std::vector<MaterialValidation> materials = {};
};

/// Does what the publication did, on all cores.
/// @param advance  called after each spectrum with how many are done, and of how many; from any
///                 thread, one at a time.
/// @throws InputError  for a refractive index that does not cover the visible wavelengths.
[[nodiscard]] ValidationResult validate(
    const ValidationPlan& plan,
    const std::function<void(std::size_t done, std::size_t total)>& advance = {});

}  // namespace gonio

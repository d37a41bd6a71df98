#include "emulator/goniometry/validation.hpp"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/integration/patch_integrator.hpp"
#include "emulator/optics/fresnel.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;

/// Asked of the aperture integrator, in the unit of the scale: a hundred-thousandth of what glass
/// reads, a digit below what is told.
constexpr double tolerance_gu = 1e-3;

constexpr std::array<ValidationModel, 3> models{
    ValidationModel::smooth, ValidationModel::energy_conserving, ValidationModel::as_printed};

Surface surface_of(ValidationModel model, double rms_slope, const WavelengthGrid& grid,
                   const ArrayXcd& n_hat) {
  switch (model) {
    case ValidationModel::smooth:
      return smooth(grid, n_hat);
    case ValidationModel::energy_conserving:
      return cook_torrance(grid, rms_slope, n_hat, {}, Normalization::energy_conserving);
    case ValidationModel::as_printed:
      break;
  }
  return cook_torrance(grid, rms_slope, n_hat, {}, Normalization::as_printed);
}

/// Work that is told of while it is done on all cores.
class Tasks {
 public:
  explicit Tasks(std::function<void(std::size_t, std::size_t)> advance)
      : advance_(std::move(advance)) {}

  void add(std::function<void()> task) { tasks_.push_back(std::move(task)); }
  void run() {
    parallel_for(tasks_.size(), [&](std::size_t i) {
      tasks_[i]();
      const std::scoped_lock lock(mutex_);
      ++done_;
      if (advance_) {
        advance_(done_, tasks_.size());
      }
    });
  }

 private:
  std::function<void(std::size_t, std::size_t)> advance_;
  std::vector<std::function<void()>> tasks_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

/// The slope between the finest and the roughest at which the mean reflectance of eq. (15) as
/// printed is that of the exact one.
std::optional<double> matching_slope(const Glossmeter& glossmeter, const std::string& geometry,
                                     const ArrayXcd& n_hat, double exact_mean) {
  constexpr double finest = 0.005, roughest = 0.5, relative_accuracy = 1e-5;
  const auto excess = [&](double log_slope) {
    const Surface surface =
        surface_of(ValidationModel::as_printed, std::exp(log_slope), glossmeter.grid(), n_hat);
    return glossmeter.read(surface, geometry, tolerance_gu).reflectance.mean() - exact_mean;
  };
  const double low = std::log(finest), high = std::log(roughest);
  const double at_low = excess(low), at_high = excess(high);
  if (!(at_low > 0.0 && at_high < 0.0)) {
    return std::nullopt;
  }
  std::uintmax_t most = 60;
  const auto [below, above] = boost::math::tools::toms748_solve(
      excess, low, high, at_low, at_high,
      [](double a, double b) { return std::abs(b - a) < relative_accuracy; }, most);
  return std::exp(0.5 * (below + above));
}

/// The virtual instrument, with either integrator.
class Bench {
 public:
  Bench(const ValidationPlan& plan, const WavelengthGrid& grid)
      : by_apertures_(plan.instrument, grid, std::make_shared<ApertureIntegrator>()),
        by_patches_(plan.instrument, grid, std::make_shared<PatchIntegrator>(plan.patches)) {}

  [[nodiscard]] const Glossmeter& with(ValidationIntegrator integrator) const {
    return integrator == ValidationIntegrator::aperture ? by_apertures_ : by_patches_;
  }

 private:
  Glossmeter by_apertures_, by_patches_;
};

/// Adds the work on one material with one refractive index.
void add_spectra(Tasks& tasks, const Bench& bench, double rms_slope, const ArrayXcd& n_hat,
                 ValidationAuthor& author) {
  for (ValidationGeometry& geometry : author.geometries) {
    for (const ValidationModel model : models) {
      for (const auto integrator :
           {ValidationIntegrator::aperture, ValidationIntegrator::patches}) {
        geometry.simulated.push_back({.model = model, .integrator = integrator});
      }
    }
    for (SimulatedSpectrum& spectrum : geometry.simulated) {
      tasks.add([&bench, &geometry, &spectrum, rms_slope, n_hat] {
        const Glossmeter& glossmeter = bench.with(spectrum.integrator);
        spectrum.reflectance =
            glossmeter
                .read(surface_of(spectrum.model, rms_slope, glossmeter.grid(), n_hat), geometry.id,
                      tolerance_gu)
                .reflectance;
        spectrum.deviation = spectral_deviation(spectrum.reflectance, geometry.exact);
      });
    }
    tasks.add([&bench, &geometry, n_hat] {
      geometry.matching_slope = matching_slope(bench.with(ValidationIntegrator::aperture),
                                               geometry.id, n_hat, geometry.exact.mean());
    });
  }
}

/// Mean over wavelength of the share of the incident flux that reaches the receptor; NaN where no
/// patch lies within the source.
double mean_reflectance(const FluxIntegrator& integrator, const Surface& surface,
                        const MeasuringGeometry& geometry) {
  const double incident = integrator.incident(geometry.source);
  if (!(incident > 0.0)) {
    return std::nan("");
  }
  constexpr double relative_tolerance = 1e-6;
  const Eigen::Index n = surface.grid.size();
  return integrator
             .reflected(surface, geometry, ArrayXd::Constant(n, 1.0 / double(n)),
                        relative_tolerance * incident)
             .spectral.mean() /
         incident;
}

/// Adds the patch method at all resolutions.
void add_convergence(Tasks& tasks, const ValidationPlan& plan, const Surface& surface,
                     MaterialValidation& material) {
  const std::vector<std::string>& geometries = plan.instrument.geometries;
  for (const int resolution : plan.convergence) {
    material.convergence.push_back(
        {.resolution = resolution, .difference = std::vector<double>(geometries.size())});
  }
  for (std::size_t g = 0; g < geometries.size(); ++g) {
    tasks.add([&plan, &material, surface, g] {
      const MeasuringGeometry geometry = plan.instrument.geometry(plan.instrument.geometries[g]);
      const double by_apertures = mean_reflectance(ApertureIntegrator(), surface, geometry);
      for (ConvergencePoint& point : material.convergence) {
        const PatchIntegrator patches(point.resolution);
        point.difference[g] = mean_reflectance(patches, surface, geometry) / by_apertures - 1.0;
      }
    });
  }
}

}  // namespace

SpectralDeviation spectral_deviation(const ArrayXd& value, const ArrayXd& reference) {
  if (value.size() != reference.size() || value.size() == 0 || !(reference.mean() > 0.0)) {
    throw std::invalid_argument("spectral_deviation: spectra of one length and a reference > 0");
  }
  const double mean = reference.mean();
  const auto rmse = [&](const ArrayXd& v) {
    return std::sqrt((v - reference).square().mean()) / mean;
  };
  const double power = value.square().sum();
  const double scale = power > 0.0 ? (value * reference).sum() / power : 0.0;
  return {.ratio = value.mean() / mean,
          .relative_rmse = rmse(value),
          .shape_rmse = rmse(scale * value)};
}

ValidationResult validate(const ValidationPlan& plan,
                          const std::function<void(std::size_t, std::size_t)>& advance) {
  ValidationResult result{.geometries = plan.instrument.geometries};
  const Bench bench(plan, result.grid);
  result.materials.resize(plan.materials.size());
  Tasks tasks(advance);
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    const ValidationMaterial& stated = plan.materials[m];
    MaterialValidation& material = result.materials[m];
    material.authors.resize(stated.indices.size());
    for (std::size_t a = 0; a < stated.indices.size(); ++a) {
      ValidationAuthor& author = material.authors[a];
      author.author = stated.indices[a].author;
      const ArrayXcd n_hat = stated.indices[a].index.sample(result.grid);
      for (const std::string& id : result.geometries) {
        const Angle theta_i = plan.instrument.angle_of_incidence(id);
        author.geometries.push_back(
            {.id = id,
             .theta_i = theta_i,
             .exact = fresnel_reflectance(std::cos(theta_i.radians()), n_hat)});
      }
      add_spectra(tasks, bench, stated.rms_slope, n_hat, author);
    }
    add_convergence(tasks, plan,
                    surface_of(ValidationModel::energy_conserving, stated.rms_slope, result.grid,
                               stated.indices.front().index.sample(result.grid)),
                    material);
  }
  tasks.run();
  return result;
}

}  // namespace gonio

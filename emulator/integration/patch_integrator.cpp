#include "emulator/integration/patch_integrator.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/lobe_flux.hpp"
#include "emulator/integration/measured_flux.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// Directions of patches and what they count: cos theta times solid angle [sr].
struct Patches {
  DirectionBatch omega;
  ArrayXd projected;

  [[nodiscard]] Index size() const { return omega.size(); }
  [[nodiscard]] Vector3 direction(Index j) const { return {omega.x(j), omega.y(j), omega.z(j)}; }
  [[nodiscard]] double solid_angle() const { return (projected / omega.z).sum(); }
};

/// Calls `use` with the patches of the hemisphere of resolution n, a row of a face at a time.
void for_each_row(Index n, const std::function<void(const Patches&)>& use) {
  const ArrayXd across = (2.0 * ArrayXd::LinSpaced(n, 0.0, double(n - 1)) + 1.0) / double(n) - 1.0;
  const double area = 4.0 / (double(n) * double(n));
  Patches row;
  row.omega.resize(n);
  for (const Aperture& face : hemicube_faces()) {
    const Index rows = face.v_low() < 0.0 ? n : n / 2;
    for (Index j = n - rows; j < n; ++j) {
      row.projected = ArrayXd::Constant(n, area);
      kernel::tangent_directions(face.frame(), across, ArrayXd::Constant(n, across(j)), row.omega,
                                 row.projected);
      use(row);
    }
  }
}

Patches patches_in(const Aperture& aperture, Index resolution) {
  Patches result;
  if (aperture.is_degenerate()) {
    const bool is_direction =
        aperture.u_low() == aperture.u_high() && aperture.v_low() == aperture.v_high();
    if (!is_direction) {
      throw std::domain_error("PatchIntegrator: an aperture must be an area or a direction");
    }
    const Vector3 omega = aperture.frame().direction(aperture.u_low(), aperture.v_low());
    result.omega = {ArrayXd::Constant(1, omega.x()), ArrayXd::Constant(1, omega.y()),
                    ArrayXd::Constant(1, omega.z())};
    result.projected = ArrayXd::Constant(1, omega.z());
    return result;
  }
  std::vector<Vector3> directions;
  std::vector<double> projected;
  for_each_row(resolution, [&](const Patches& row) {
    for (Index j = 0; j < row.size(); ++j) {
      if (aperture.contains(row.direction(j))) {
        directions.push_back(row.direction(j));
        projected.push_back(row.projected(j));
      }
    }
  });
  const auto n = Index(directions.size());
  result.omega.resize(n);
  for (Index j = 0; j < n; ++j) {
    result.omega.x(j) = directions[std::size_t(j)].x();
    result.omega.y(j) = directions[std::size_t(j)].y();
    result.omega.z(j) = directions[std::size_t(j)].z();
  }
  result.projected = Eigen::Map<const ArrayXd>(projected.data(), n);
  return result;
}

/// Sums over batches of directions: of one lobe, as moments, one column for each wavelength if the
/// shape changes with it, else one column; or of one measured term, by channel.
class TermSum {
 public:
  TermSum(const Lobe& lobe, const CosineRange& range)
      : series_(std::make_unique<ColourSeries>(lobe.colour, range.low, range.high, accuracy)),
        spectra_(series_->coefficient) {
    for (Index l = 0; l < std::max<Index>(1, lobe.shape_parameter.size()); ++l) {
      const double parameter = lobe.shape_parameter.size() > 0 ? lobe.shape_parameter(l) : 0.0;
      integrands_.push_back(
          std::make_unique<LobeIntegrand>(lobe, parameter, *series_, any_weight()));
    }
    sums_.setZero(spectra_.rows(), Index(integrands_.size()));
  }
  explicit TermSum(const MeasuredTerm& term) : spectra_(term.spectra) {
    integrands_.push_back(std::make_unique<MeasuredIntegrand>(term, any_weight()));
    sums_.setZero(spectra_.rows(), 1);
  }

  /// Adds factor * sum_j f_r(omega_i, omega_r(j)) projected(j).
  void add(const Vector3& omega_i, const Patches& receptor, double factor) {
    for (Index l = 0; l < sums_.cols(); ++l) {
      Integrand& integrand = *integrands_[std::size_t(l)];
      integrand.evaluate(omega_i, receptor.omega);
      weight_ = factor * receptor.projected;
      integrand.add(weight_, sums_.col(l));
    }
  }

  [[nodiscard]] ArrayXd spectral() const {
    if (sums_.cols() > 1) {
      return spectra_.cwiseProduct(sums_).colwise().sum().transpose();
    }
    return spectra_.transpose() * sums_.col(0);
  }

 private:
  static constexpr double accuracy = 1e-9;
  /// Sums need no functional.
  [[nodiscard]] ArrayXd any_weight() const { return ArrayXd::Zero(spectra_.cols()); }

  std::unique_ptr<const ColourSeries> series_;  // of a lobe
  Eigen::MatrixXd spectra_;                     // of each sum, shape (n_k, n_lambda)
  std::vector<std::unique_ptr<Integrand>> integrands_;
  Eigen::MatrixXd sums_;
  ArrayXd weight_;
};

std::vector<TermSum> sums_of(const Surface& surface, const CosineRange& range) {
  std::vector<TermSum> sums;
  for (const Lobe& lobe : surface.lobes) {
    sums.emplace_back(lobe, range);
  }
  for (const MeasuredTerm& term : surface.measured) {
    sums.emplace_back(term);
  }
  return sums;
}

ArrayXd reflected_at(Index resolution, const Surface& surface, const MeasuringGeometry& geometry) {
  const Patches source = patches_in(geometry.source, resolution);
  const Patches receptor = patches_in(geometry.receptor, resolution);
  ArrayXd sum = ArrayXd::Zero(surface.grid.size());
  for (Index k = 0; k < source.size() && !surface.interfaces.empty(); ++k) {
    const Vector3 omega_i = source.direction(k);
    if (geometry.receptor.contains(mirrored(omega_i))) {
      sum += source.projected(k) * surface.specular_reflectance(omega_i.z());
    }
  }
  for (TermSum& term_sum : sums_of(surface, half_angle_range(geometry))) {
    for (Index k = 0; k < source.size(); ++k) {
      term_sum.add(source.direction(k), receptor, source.projected(k));
    }
    sum += term_sum.spectral();
  }
  return sum;
}

ArrayXd hemispherical_at(Index resolution, const Surface& surface, const Vector3& omega_i) {
  const double theta_i = std::acos(std::min(omega_i.z(), 1.0));
  const CosineRange range{.low = std::cos(0.5 * theta_i + 0.25 * std::numbers::pi), .high = 1.0};
  std::vector<TermSum> sums = sums_of(surface, range);
  for_each_row(resolution, [&](const Patches& row) {
    for (TermSum& sum : sums) {
      sum.add(omega_i, row, 1.0);
    }
  });
  ArrayXd total = surface.specular_reflectance(omega_i.z());
  for (const TermSum& sum : sums) {
    total += sum.spectral();
  }
  return total;
}

/// By what share the patches of an aperture miss its solid angle.
double solid_angle_error(const Aperture& aperture, Index resolution) {
  if (aperture.is_degenerate()) {
    return 0.0;
  }
  return std::abs(patches_in(aperture, resolution).solid_angle() / aperture.solid_angle() - 1.0);
}

}  // namespace

PatchIntegrator::PatchIntegrator(Index resolution) : resolution_(resolution) {
  if (resolution < 4 || resolution % 4 != 0) {
    throw std::domain_error("PatchIntegrator: the resolution must be a multiple of 4, is " +
                            std::to_string(resolution));
  }
}

Flux PatchIntegrator::reflected(const Surface& surface, const MeasuringGeometry& geometry,
                                const ArrayXd& weight, double /*tolerance*/) const {
  Flux flux{.spectral = reflected_at(resolution_, surface, geometry)};
  const double luminous = (weight * flux.spectral).sum();
  flux.error = solid_angle_error(geometry.receptor, resolution_) * luminous;
  const double coarse_incident = patches_in(geometry.source, resolution_ / 2).projected.sum();
  if (coarse_incident > 0.0) {
    const ArrayXd coarse = reflected_at(resolution_ / 2, surface, geometry) *
                           (incident(geometry.source) / coarse_incident);
    flux.error = std::max(flux.error, std::abs(luminous - (weight * coarse).sum()));
  }
  return flux;
}

double PatchIntegrator::incident(const Aperture& source) const {
  return patches_in(source, resolution_).projected.sum();
}

Flux PatchIntegrator::hemispherical(const Surface& surface, const Vector3& omega_i,
                                    const ArrayXd& weight, double /*tolerance*/) const {
  Flux flux{.spectral = hemispherical_at(resolution_, surface, omega_i)};
  const ArrayXd coarse = hemispherical_at(resolution_ / 2, surface, omega_i);
  flux.error = std::abs((weight * (flux.spectral - coarse)).sum());
  return flux;
}

}  // namespace gonio

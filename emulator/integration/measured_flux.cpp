#include "emulator/integration/measured_flux.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

namespace {

using Eigen::ArrayXd;

/// How many cells all steps together may take.
constexpr std::size_t most_table_cells = 6'000;

}  // namespace

SlopeWidth MeasuredIntegrand::slope_width(double cos_theta_i) const {
  const double theta_i = std::acos(std::clamp(cos_theta_i, -1.0, 1.0));
  const double least = 1e-4;  // as narrow as lobes come
  const double slope = std::max(0.5 * brdf_.step(radians(theta_i)).radians(), least);
  return {.x = slope, .y = slope / std::max(cos_theta_i, least)};
}

void MeasuredIntegrand::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r) {
  f_r_.resize(omega_r.size(), functional().size());
  brdf_.evaluate(omega_i, omega_r, f_r_);
}

void MeasuredIntegrand::control(ArrayXd& value) { value = f_r_.matrix() * functional(); }

void MeasuredIntegrand::add(ArrayXd& weight, Eigen::Ref<Eigen::VectorXd> sum) {
  sum += f_r_.matrix().transpose() * weight.matrix();
}

Flux measured_flux(const MeasuredTerm& term, const MeasuringGeometry& geometry,
                   const ArrayXd& weight, double tolerance, double incident) {
  constexpr double tightening = 8.0;  // of the tolerance from step to step,
  constexpr std::size_t growth = 4;   // which takes that many times the cells, at most
  MeasuredIntegrand integrand(term, weight);
  const auto weighted = [&](const Integral& sum) { return integrand.functional().dot(sum.value); };
  std::size_t budget = most_table_cells;
  Integral best = nested_integral(integrand, geometry, incident, incident, budget);
  double step = std::max(tolerance, best.error);
  for (std::size_t before = budget, used = most_table_cells - budget;
       best.error > tolerance && growth * used <= budget; used = before - budget) {
    before = budget;
    step = std::max(tolerance, std::min(step, weighted(best)) / tightening);
    Integral next = nested_integral(integrand, geometry, step, incident, budget);
    if (next.error < best.error) {
      best = std::move(next);
    }
  }
  return {.spectral = (term.spectra.transpose() * best.value).array(), .error = best.error};
}

}  // namespace gonio

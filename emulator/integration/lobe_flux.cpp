#include "emulator/integration/lobe_flux.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/integration/batch_kernels.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Where the integral of one lobe gives up: after about a second.
constexpr std::size_t most_cells = 1'000'000;

}  // namespace

void LobeIntegrand::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r) {
  x_.resize(omega_r.size());
  g_.resize(omega_r.size());
  lobe_.shape->evaluate(parameter_, omega_i, omega_r, g_);
  kernel::half_angle_argument(omega_i, omega_r, series_.scale, series_.shift, x_);
}

void LobeIntegrand::control(ArrayXd& value) {
  value.resize(x_.size());
  kernel::chebyshev_series(functional(), x_, value);
  value *= g_;
}

void LobeIntegrand::add(ArrayXd& weight, Eigen::Ref<Eigen::VectorXd> sum) {
  weight *= g_;
  kernel::add_chebyshev_moments(x_, weight, sum);
}

LobeFlux::LobeFlux(const Lobe& lobe, const MeasuringGeometry& geometry, const ArrayXd& weight,
                   double tolerance, double incident)
    : lobe_(lobe),
      geometry_(geometry),
      weight_(weight),
      tolerance_(tolerance),
      incident_(incident),
      series_(lobe.colour, half_angle_range(geometry).low, half_angle_range(geometry).high,
              0.02 * tolerance / incident) {}

Flux LobeFlux::operator()() const {
  return lobe_.shape_parameter.size() == 0 ? with_fixed_shape(0.0) : with_changing_shape();
}

/// Moments over both apertures.
Integral LobeFlux::moments(double parameter, double tolerance) const {
  std::size_t budget = most_cells;
  LobeIntegrand integrand(lobe_, parameter, series_, weight_);
  return nested_integral(integrand, geometry_, tolerance, incident_, budget);
}

Flux LobeFlux::with_fixed_shape(double parameter) const {
  const Integral sum = moments(parameter, tolerance_);
  return {.spectral = (series_.coefficient.transpose() * sum.value).array(),
          .error = sum.error + std::abs(sum.value(0)) * series_.truncation.maxCoeff()};
}

/// Points of the parameter are doubled until the flux settles.
Flux LobeFlux::with_changing_shape() const {
  constexpr Index most_points = 65;
  const double low = lobe_.shape_parameter.minCoeff();
  const double high = lobe_.shape_parameter.maxCoeff();
  const double node_tolerance = 0.3 * tolerance_;  // interpolation amplifies by less than 2
  if (high - low <= 1e-12 * high) {
    return with_fixed_shape(low);
  }
  const ArrayXd x = (2.0 * lobe_.shape_parameter - (low + high)) / (high - low);
  std::vector<Integral> at_point;
  Flux before;
  for (Index n = 3;; n = 2 * n - 1) {
    const ArrayXd point = chebyshev_points(n);
    std::vector<Integral> now;
    Eigen::MatrixXd at_points(series_.coefficient.rows(), n);
    double error = 0.0;
    for (Index j = 0; j < n; ++j) {  // every second point is one of the n before
      const double parameter = 0.5 * ((high + low) + (high - low) * point(j));
      now.push_back(!at_point.empty() && j % 2 == 0 ? at_point[std::size_t(j / 2)]
                                                    : moments(parameter, node_tolerance));
      at_points.col(j) = now.back().value;
      error = std::max(error, 2.0 * now.back().error);
    }
    at_point = std::move(now);
    const Eigen::MatrixXd at_lambda = at_points * chebyshev_interpolation(n, x).transpose();
    Flux flux{
        .spectral = series_.coefficient.cwiseProduct(at_lambda).colwise().sum().transpose(),
        .error = error + at_lambda.row(0).cwiseAbs().maxCoeff() * series_.truncation.maxCoeff()};
    if (n > 3) {
      const double change = (weight_ * (flux.spectral - before.spectral).abs()).sum();
      flux.error += change;
      if (change <= 0.3 * tolerance_ || n >= most_points) {
        return flux;
      }
    }
    before = flux;
  }
}

}  // namespace gonio

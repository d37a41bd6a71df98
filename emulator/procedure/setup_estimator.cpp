#include "emulator/procedure/setup_estimator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of a quantity whose tolerance the standard does not state.
constexpr double usual_tolerance_deg = 0.1;
constexpr double grazing_deg = 89.9;

/// The step of central differences of the optics, in units of the prior: far below how wide images
/// and lobes are and far above the noise of the integrator.
constexpr double optics_step = 0.1;

double tolerance_deg(const GeometryLimits& limits, SetupQuantity quantity) {
  const Stated<Angle>* limit = limit_of(limits, quantity);
  return limit != nullptr && limit->tolerance ? limit->tolerance->degrees() : usual_tolerance_deg;
}

std::vector<EstimatedParameter> parameters_before(const OpticalResponse& response,
                                                  const GeometryLimits& limits,
                                                  const SetupEstimateOptions& options) {
  std::vector<EstimatedParameter> parameters;
  const auto add = [&](const char* name, const char* unit, double assumed, double prior) {
    parameters.push_back({.name = name,
                          .unit = unit,
                          .assumed = assumed,
                          .prior_uncertainty = prior,
                          .estimate = assumed,
                          .standard_uncertainty = prior});
  };
  for (std::size_t i = 0; i < response.quantities().size(); ++i) {
    const SetupQuantity quantity = response.quantities()[i];
    add(setup_quantity_names[std::size_t(quantity)], "deg", response.as_built()(Index(i)),
        options.prior_tolerances * tolerance_deg(limits, quantity));
  }
  add("reference_value", "", 0.0, options.prior_reference_value);
  add("zero", "GU", 0.0, options.prior_zero_gu);
  return parameters;
}

VectorXd vector_of(const std::vector<EstimatedParameter>& parameters,
                   double EstimatedParameter::*member) {
  VectorXd values(Index(parameters.size()));
  std::ranges::transform(parameters, values.begin(), member);
  return values;
}

/// Standard, in GU.
double uncertainty_of(const TileReading& reading, const Behaviour& behaviour) {
  if (reading.expanded_uncertainty_gu) {
    return *reading.expanded_uncertainty_gu / 2.0;
  }
  const double u =
      std::hypot(behaviour.repeatability_gu, behaviour.resolution_gu / std::sqrt(12.0));
  if (!(u > 0.0)) {
    throw InputError(reading.mark,
                     "an expanded_uncertainty_gu, as the instrument states neither a repeatability "
                     "nor a resolution",
                     "nothing");
  }
  return u;
}

std::vector<std::vector<double>> correlation_of(const MatrixXd& covariance) {
  const Index n = covariance.rows();
  std::vector<std::vector<double>> rows(std::size_t(n), std::vector<double>(std::size_t(n), 1.0));
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      if (i != j) {
        rows[std::size_t(i)][std::size_t(j)] =
            covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      }
    }
  }
  return rows;
}

}  // namespace

SetupEstimator::SetupEstimator(const Instrument& instrument, std::string geometry_id,
                               const std::vector<Sample>& tiles,
                               const SetupEstimateOptions& options)
    : response_(instrument, geometry_id, tiles, options.tolerance),
      geometry_id_(std::move(geometry_id)),
      behaviour_(instrument.behaviour),
      equation_(measurement_equation(instrument, geometry_id_)),
      parameters_(
          parameters_before(response_, instrument.standard.geometry(geometry_id_), options)),
      assumed_(vector_of(parameters_, &EstimatedParameter::assumed)),
      prior_(vector_of(parameters_, &EstimatedParameter::prior_uncertainty)) {
  (void)response_(response_.as_built());  // throws where the search could not begin
  jacobian_assumed_ = jacobian(assumed_);
}

/// What the optics read. @param x  the quantities of the set-up alone.
VectorXd SetupEstimator::optics(const VectorXd& x) const {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  VectorXd all = response_.as_built();
  all.head(x.size()) = x;
  const auto n_tiles = response_.samples();
  if (!(x.array().abs() < grazing_deg).all()) {
    return VectorXd::Constant(n_tiles, nowhere);
  }
  try {
    return response_(all);
  } catch (const InputError&) {  // the image of the source lies beside the receptor
    return VectorXd::Constant(n_tiles, nowhere);
  }
}

/// By central differences; by one side where light misses the receptor on the other.
/// @param here  optics(x)
MatrixXd SetupEstimator::optics_jacobian(const VectorXd& x, const VectorXd& here) const {
  const Index n = x.size();
  MatrixXd derivatives = MatrixXd::Zero(here.size(), n);
  parallel_for(std::size_t(n), [&](std::size_t k) {
    const auto i = Index(k);
    double width = 0.0;
    for (const double side : {1.0, -1.0}) {
      const double h = optics_step * prior_(i);
      const VectorXd there = optics(x + side * h * VectorXd::Unit(n, i));
      if (there.allFinite()) {
        derivatives.col(i) += side * (there - here);
        width += h;
      }
    }
    derivatives.col(i) /= std::max(width, std::numeric_limits<double>::min());
  });
  return derivatives;
}

MeasurementEquation::Components<double> SetupEstimator::components(const VectorXd& x) const {
  MeasurementEquation::Components<double> d{};
  d[std::size_t(UncertaintyComponent::linearity)] = behaviour_.linearity;
  d[std::size_t(UncertaintyComponent::reference_value)] =
      x(x.size() - 2) * equation_.scale.value.nominal;
  d[std::size_t(UncertaintyComponent::zero)] = x(x.size() - 1);
  return d;
}

VectorXd SetupEstimator::reading(const VectorXd& x) const {
  const auto d = components(x);
  return optics(x.head(x.size() - 2)).unaryExpr([&](double g) {
    return std::isfinite(g) ? equation_.reading(g, d) : g;
  });
}

MatrixXd SetupEstimator::jacobian(const VectorXd& x) const {
  const Index n = x.size() - 2;
  const auto d = components(x);
  const VectorXd g = optics(x.head(n));
  const MatrixXd of_optics = optics_jacobian(x.head(n), g);
  MatrixXd derivatives(g.size(), x.size());
  for (Index i = 0; i < g.size(); ++i) {
    const auto gradient = equation_.gradient(g(i), d);
    const auto by = [&](UncertaintyComponent component) {
      return gradient.by_component[std::size_t(component)];
    };
    derivatives.row(i) << gradient.by_optics * of_optics.row(i),
        by(UncertaintyComponent::reference_value) * equation_.scale.value.nominal,
        by(UncertaintyComponent::zero);
  }
  return derivatives;
}

PriorFitProblem SetupEstimator::problem(const std::vector<TileReading>& readings,
                                        const std::vector<std::size_t>& tile_of) const {
  const Index n_tiles = response_.samples();
  if (tile_of.size() != readings.size() ||
      std::ranges::any_of(tile_of, [&](std::size_t tile) { return Index(tile) >= n_tiles; })) {
    throw std::invalid_argument(
        fmt::format("SetupEstimator: each reading needs one of {} tiles", n_tiles));
  }
  const std::vector<Index> rows(tile_of.begin(), tile_of.end());
  PriorFitProblem problem{
      .model = [this, rows](const VectorXd& x) -> VectorXd { return reading(x)(rows); },
      .jacobian = [this, rows](const VectorXd& x) -> MatrixXd {
        return jacobian(x)(rows, Eigen::all);
      },
      .observed = VectorXd(Index(readings.size())),
      .u_observed = VectorXd(Index(readings.size())),
      .assumed = assumed_,
      .u_assumed = prior_,
      .jacobian_assumed = jacobian_assumed_(rows, Eigen::all)};
  for (std::size_t i = 0; i < readings.size(); ++i) {
    problem.observed(Index(i)) = readings[i].gloss_gu;
    problem.u_observed(Index(i)) = uncertainty_of(readings[i], behaviour_);
  }
  return problem;
}

SetupEstimate SetupEstimator::estimate(const std::vector<TileReading>& readings,
                                       const std::vector<std::size_t>& tile_of) const {
  const PriorFit fit = fit_with_prior(problem(readings, tile_of));
  SetupEstimate result{.geometry = geometry_id_,
                       .parameters = parameters_,
                       .correlation = correlation_of(fit.covariance),
                       .confusions = confusions_of(fit.covariance, prior_),
                       .residual_gu = {fit.residual.begin(), fit.residual.end()},
                       .readings = readings,
                       .chi_squared = fit.chi_squared,
                       .degrees_of_freedom = readings.size(),
                       .p_value = fit.p_value,
                       .has_converged = fit.has_converged};
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    EstimatedParameter& parameter = result.parameters[i];
    parameter.estimate = fit.estimate(Index(i));
    parameter.standard_uncertainty = std::sqrt(fit.covariance(Index(i), Index(i)));
    parameter.is_determined = parameter.standard_uncertainty <= 0.5 * parameter.prior_uncertainty;
  }
  return result;
}

}  // namespace gonio

#include "emulator/goniometry/surface_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

#include "emulator/goniometry/amplitude_fit.hpp"
#include "emulator/goniometry/fit_uncertainty.hpp"
#include "emulator/goniometry/model_responses.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A shape within this share of the way to a bound has reached it.
constexpr double near_bound = 1e-6;

double to_scale(const FitParameter& parameter, double value) {
  if (parameter.scale == FitParameter::Scale::log) {
    return std::log(value);
  }
  const double share = (value - parameter.low) / (parameter.high - parameter.low);
  const double inside = std::clamp(share, near_bound, 1.0 - near_bound);
  return std::log(inside / (1.0 - inside));
}

double from_scale(const FitParameter& parameter, double t) {
  const double value =
      parameter.scale == FitParameter::Scale::log
          ? std::exp(t)
          : parameter.low + (parameter.high - parameter.low) / (1.0 + std::exp(-t));
  return std::clamp(value, parameter.low, parameter.high);
}

bool is_amplitude(const FitParameter& parameter) {
  return parameter.scale == FitParameter::Scale::amplitude;
}

/// The residuals of a model over its free shapes, its amplitudes being the best of each.
class Projection {
 public:
  Projection(const FitObservations& observations, ModelResponses& responses, const FitValues& fixed)
      : model_(responses.model()),
        responses_(responses),
        u_(observations.u),
        observed_(observations.observed.cwiseQuotient(observations.u)) {
    for (const FitParameter& parameter : model_.parameters) {
      const auto found = fixed.find(parameter.name);
      if (found != fixed.end()) {
        fixed_.insert(*found);
      } else {
        (is_amplitude(parameter) ? amplitudes_ : shapes_).push_back(&parameter);
      }
    }
  }

  [[nodiscard]] const std::vector<const FitParameter*>& shapes() const { return shapes_; }
  [[nodiscard]] const std::vector<const FitParameter*>& amplitudes() const { return amplitudes_; }
  [[nodiscard]] const VectorXd& observed() const { return observed_; }

  [[nodiscard]] FitValues shapes_at(const VectorXd& t) const {
    FitValues values = fixed_;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      values[shapes_[i]->name] = from_scale(*shapes_[i], t(Index(i)));
    }
    return values;
  }

  /// Responses of the terms with a free amplitude, shape (n, n_amplitudes).
  MatrixXd free_terms(const FitValues& values) {
    MatrixXd terms(observed_.size(), Index(amplitudes_.size()));
    for (std::size_t a = 0; a < amplitudes_.size(); ++a) {
      for (std::size_t i = 0; i < model_.terms.size(); ++i) {
        if (model_.terms[i].amplitude == amplitudes_[a]->name) {
          terms.col(Index(a)) = responses_.of(i, values).cwiseQuotient(u_);
        }
      }
    }
    return terms;
  }
  /// The sum of the other terms.
  VectorXd fixed_terms(const FitValues& values) {
    VectorXd sum = VectorXd::Zero(observed_.size());
    for (std::size_t i = 0; i < model_.terms.size(); ++i) {
      const std::string& name = model_.terms[i].amplitude;
      const double amplitude = name.empty() ? 1.0 : fixed_.contains(name) ? fixed_.at(name) : 0.0;
      if (amplitude > 0.0) {
        sum += amplitude * responses_.of(i, values).cwiseQuotient(u_);
      }
    }
    return sum;
  }
  AmplitudeFit amplitudes_at(const FitValues& values) {
    double left = 1.0;
    for (const FitParameter& parameter : model_.parameters) {
      if (is_amplitude(parameter) && fixed_.contains(parameter.name)) {
        left -= fixed_.at(parameter.name);
      }
    }
    return fit_amplitudes(free_terms(values), observed_ - fixed_terms(values), std::max(left, 0.0));
  }
  VectorXd residuals(const VectorXd& t) {
    const FitValues values = shapes_at(t);
    const AmplitudeFit fit = amplitudes_at(values);
    return observed_ - fixed_terms(values) - free_terms(values) * fit.amplitudes;
  }
  /// All responses together for values of all parameters.
  VectorXd response(const FitValues& values) {
    VectorXd sum = fixed_terms(values);
    const MatrixXd terms = free_terms(values);
    for (std::size_t a = 0; a < amplitudes_.size(); ++a) {
      sum += values.at(amplitudes_[a]->name) * terms.col(Index(a));
    }
    return sum;
  }

  // The interface of Eigen::LevenbergMarquardt.
  [[nodiscard]] int values() const { return int(observed_.size()); }
  int operator()(const VectorXd& t, VectorXd& left) {
    left = residuals(t);
    return 0;
  }
  int df(const VectorXd& t, MatrixXd& derivatives) {
    derivatives.resize(observed_.size(), t.size());
    for (Index i = 0; i < t.size(); ++i) {
      VectorXd above = t, below = t;
      above(i) += step;
      below(i) -= step;
      derivatives.col(i) = (residuals(above) - residuals(below)) / (2.0 * step);
    }
    return 0;
  }

  /// Of a derivative, in the scale of a shape: its error is of the order of its square, and it is
  /// far above the quadrature's.
  static constexpr double step = 1e-3;

 private:
  const FittableModel& model_;
  ModelResponses& responses_;
  const VectorXd& u_;
  VectorXd observed_;
  FitValues fixed_;
  std::vector<const FitParameter*> shapes_, amplitudes_;
};

/// The best of all starts, the best first.
std::vector<VectorXd> best_starts(Projection& problem, const FittableModel& model,
                                  std::size_t count) {
  const auto& shapes = problem.shapes();
  if (shapes.empty()) {
    return {VectorXd()};
  }
  std::vector<std::pair<double, VectorXd>> tried;
  for (const FitValues& start : model.starts) {
    VectorXd t(Index(shapes.size()));
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      t(Index(i)) = to_scale(*shapes[i], start.at(shapes[i]->name));
    }
    const bool is_known =  // the rest of it is fixed
        std::ranges::any_of(tried, [&](const auto& other) { return other.second == t; });
    if (!is_known) {
      tried.emplace_back(problem.residuals(t).squaredNorm(), t);
    }
  }
  std::ranges::stable_sort(tried, {}, &std::pair<double, VectorXd>::first);
  std::vector<VectorXd> starts;
  constexpr double hopeless = 4.0;  // times as much as the best start leaves
  for (std::size_t i = 0; i < std::min(count, tried.size()); ++i) {
    if (tried[i].first <= hopeless * tried.front().first) {
      starts.push_back(tried[i].second);
    }
  }
  return starts;
}

struct Minimum {
  VectorXd t;
  double chi_squared = std::numeric_limits<double>::infinity();
  bool has_converged = true;
};

Minimum search(Projection& problem, const FittableModel& model) {
  constexpr std::size_t searches = 2;
  constexpr double accuracy = 1e-10;
  constexpr Index most_evaluations = 200;
  constexpr double first_step = 0.1;  // of the logarithms: less than to the next start
  Minimum best;
  for (VectorXd t : best_starts(problem, model, searches)) {
    bool has_converged = true;
    if (t.size() > 0) {
      Eigen::LevenbergMarquardt<Projection> steps(problem);
      steps.parameters.ftol = accuracy;
      steps.parameters.xtol = accuracy;
      steps.parameters.maxfev = most_evaluations;
      steps.parameters.factor = first_step;
      const auto status = steps.minimize(t);
      has_converged = status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation &&
                      status != Eigen::LevenbergMarquardtSpace::ImproperInputParameters;
    }
    const double chi_squared = problem.residuals(t).squaredNorm();
    if (chi_squared < best.chi_squared) {
      best = {.t = t, .chi_squared = chi_squared, .has_converged = has_converged};
    }
  }
  return best;
}

bool is_at_bound(const FitParameter& parameter, double value) {
  const double room = near_bound * (parameter.high - parameter.low);
  return parameter.scale == FitParameter::Scale::log
             ? value <= parameter.low * (1.0 + near_bound) || value >= parameter.high - room
             : value <= parameter.low + 2.0 * room || value >= parameter.high - 2.0 * room;
}

/// The values of all parameters, and what may change them: derivatives of the response along free
/// directions, and these directions in the space of the parameters.
FitSensitivity sensitivity_of(Projection& problem, const FittableModel& model,
                              const FitValues& values, const AmplitudeFit& amplitudes) {
  const Index p = Index(model.parameters.size());
  const auto row = [&](const FitParameter* wanted) {
    return Index(wanted - model.parameters.data());
  };
  FitSensitivity made{.directions = MatrixXd::Zero(p, 0)};
  const auto add = [&](const VectorXd& direction, const VectorXd& derivative) {
    const Index n = made.directions.cols();
    made.directions.conservativeResize(p, n + 1);
    made.directions.col(n) = direction;
    made.derivatives.conservativeResize(derivative.size(), n + 1);
    made.derivatives.col(n) = derivative;
  };
  for (const FitParameter* shape : problem.shapes()) {
    if (is_at_bound(*shape, values.at(shape->name))) {
      continue;
    }
    const double t = to_scale(*shape, values.at(shape->name));
    FitValues above = values, below = values;
    above[shape->name] = from_scale(*shape, t + Projection::step);
    below[shape->name] = from_scale(*shape, t - Projection::step);
    add(VectorXd::Unit(p, row(shape)), (problem.response(above) - problem.response(below)) /
                                           (above[shape->name] - below[shape->name]));
  }
  const MatrixXd terms = problem.free_terms(values);
  for (Index j = 0; j < amplitudes.free.cols(); ++j) {
    VectorXd direction = VectorXd::Zero(p);
    for (std::size_t a = 0; a < problem.amplitudes().size(); ++a) {
      direction(row(problem.amplitudes()[a])) = amplitudes.free(Index(a), j);
    }
    add(direction, terms * amplitudes.free.col(j));
  }
  return made;
}

void expect_sound(const FitObservations& observations, const FittableModel& model,
                  const FitValues& fixed) {
  Index sought = 0;
  double amplitudes = 0.0;
  for (const FitParameter& parameter : model.parameters) {
    const auto found = fixed.find(parameter.name);
    if (found == fixed.end()) {
      ++sought;
    } else if (!(found->second >= parameter.low && found->second <= parameter.high)) {
      throw std::invalid_argument(
          fmt::format("{} of {}: expected a number in [{:g}, {:g}], found {}", parameter.name,
                      model.name, parameter.low, parameter.high, found->second));
    } else if (is_amplitude(parameter)) {
      amplitudes += found->second;
    }
  }
  constexpr double rounding = 1e-12;
  if (amplitudes > 1.0 + rounding) {
    throw std::invalid_argument(fmt::format(
        "{}: fixed shares of the light have a sum of {:g}, beyond 1", model.name, amplitudes));
  }
  if (observations.observed.size() <= sought) {
    throw std::invalid_argument(
        fmt::format("{}: expected more than {} values to find {} parameters of {}, found {}",
                    observations.file.empty() ? "data" : observations.file, sought, sought,
                    model.name, observations.observed.size()));
  }
}

std::vector<FitDeviation> deviations_of(const FitObservations& observations,
                                        const VectorXd& fitted) {
  std::vector<FitDeviation> deviations;
  for (const FitGroup& group : observations.groups) {
    const auto observed = observations.observed.segment(group.first, group.size());
    const double rmse =
        std::sqrt((fitted.segment(group.first, group.size()) - observed).squaredNorm() /
                  double(group.size()));
    deviations.push_back(
        {.group = group.id, .rmse = rmse, .relative_rmse = rmse / observed.mean()});
  }
  return deviations;
}

SurfaceFit fitted(const FitObservations& observations, ModelResponses& responses,
                  const FitValues& fixed) {
  const FittableModel& model = responses.model();
  Projection problem(observations, responses, fixed);
  const Minimum minimum = search(problem, model);
  FitValues values = problem.shapes_at(minimum.t);
  const AmplitudeFit amplitudes = problem.amplitudes_at(values);
  for (std::size_t a = 0; a < problem.amplitudes().size(); ++a) {
    values[problem.amplitudes()[a]->name] = amplitudes.amplitudes(Index(a));
  }
  const VectorXd response = problem.response(values);
  SurfaceFit fit{.model = model.name,
                 .title = model.title,
                 .fitted = response.cwiseProduct(observations.u),
                 .residual = problem.observed() - response,
                 .sought = int(problem.shapes().size() + problem.amplitudes().size()),
                 .has_converged = minimum.has_converged};
  fit.chi_squared = fit.residual.squaredNorm();
  fit.deviations = deviations_of(observations, fit.fitted);
  for (const FitParameter& parameter : model.parameters) {
    fit.parameters.push_back({.name = parameter.name,
                              .value = values.at(parameter.name),
                              .state = fixed.contains(parameter.name)
                                           ? FittedParameter::State::fixed
                                           : FittedParameter::State::free});
  }
  state_uncertainty(fit, observations, model, sensitivity_of(problem, model, values, amplitudes));
  return fit;
}

}  // namespace

FitValues SurfaceFit::values() const {
  FitValues values;
  for (const FittedParameter& parameter : parameters) {
    values[parameter.name] = parameter.value;
  }
  return values;
}

const FittedParameter& SurfaceFit::parameter(const std::string& name) const {
  const auto found = std::ranges::find(parameters, name, &FittedParameter::name);
  if (found == parameters.end()) {
    throw std::out_of_range(fmt::format("{} has no parameter {}", model, name));
  }
  return *found;
}

SurfaceFit fit_surface(const FitObservations& observations, ModelResponses& responses,
                       const FitValues& fixed) {
  const FittableModel& model = responses.model();
  expect_sound(observations, model, fixed);
  try {
    return fitted(observations, responses, fixed);
  } catch (const std::domain_error& error) {  // of a model that this material cannot have
    throw std::invalid_argument(fmt::format("{}: {}", model.name, error.what()));
  }
}

SurfaceFit fit_surface(const FitObservations& observations, const FittableModel& model,
                       const Eigen::ArrayXcd& n_hat, const FitValues& fixed) {
  ModelResponses responses(observations, model, n_hat);
  return fit_surface(observations, responses, fixed);
}

}  // namespace gonio

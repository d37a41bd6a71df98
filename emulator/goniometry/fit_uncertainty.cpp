#include "emulator/goniometry/fit_uncertainty.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = FittedParameter::State;

constexpr double upper_tail = 0.025;

/// What observations tell of parameters: their covariance for errors of 1, and how far each lies
/// in directions that change nothing.
struct Knowledge {
  MatrixXd covariance;  ///< shape (p, p)
  VectorXd unknown;     ///< in [0, 1], shape (p)
};

Knowledge knowledge_of(const FitSensitivity& sensitivity, Index p) {
  Knowledge made{.covariance = MatrixXd::Zero(p, p), .unknown = VectorXd::Zero(p)};
  const Index n = sensitivity.directions.cols();
  if (n == 0) {
    return made;
  }
  /// Of derivatives scaled to norm 1: a direction that weighs less is lost in their own error.
  constexpr double lost = 1e-5;
  const VectorXd norm = sensitivity.derivatives.colwise().norm().transpose().cwiseMax(
      std::numeric_limits<double>::min());
  const MatrixXd scaled = sensitivity.derivatives * norm.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  for (Index i = 0; i < n; ++i) {
    const double s = svd.singularValues()(i);
    const VectorXd direction = sensitivity.directions * (svd.matrixV().col(i).cwiseQuotient(norm));
    if (s > lost) {
      made.covariance += direction * direction.transpose() / (s * s);
    } else {
      const VectorXd combination = sensitivity.directions * svd.matrixV().col(i);
      made.unknown = made.unknown.cwiseMax(combination.cwiseAbs());
    }
  }
  return made;
}

/// The quantile that an interval of 95 % takes.
double coverage_factor(bool is_u_known, double degrees_of_freedom) {
  using boost::math::complement;
  using boost::math::quantile;
  return is_u_known ? quantile(complement(boost::math::normal(), upper_tail))
                    : quantile(complement(
                          boost::math::students_t(std::max(degrees_of_freedom, 1.0)), upper_tail));
}

/// Of what lies between 0 and infinity the logarithm is spread evenly, so that its interval is.
void set_interval(FittedParameter& fitted, const FitParameter& parameter, double factor) {
  const double half = factor * fitted.u;
  if (parameter.scale == FitParameter::Scale::log) {
    fitted.low = fitted.value * std::exp(-half / fitted.value);
    fitted.high = fitted.value * std::exp(half / fitted.value);
  } else {
    fitted.low = fitted.value - half;
    fitted.high = fitted.value + half;
  }
  fitted.low = std::max(fitted.low, parameter.low);
  fitted.high = std::min(fitted.high, parameter.high);
}

MatrixXd correlation_of(const MatrixXd& covariance,
                        const std::vector<FittedParameter>& parameters) {
  std::vector<Index> free;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].state == State::free) {
      free.push_back(Index(i));
    }
  }
  MatrixXd correlation(Index(free.size()), Index(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < free.size(); ++j) {
      correlation(Index(i), Index(j)) =
          covariance(free[i], free[j]) /
          std::sqrt(covariance(free[i], free[i]) * covariance(free[j], free[j]));
    }
  }
  return correlation;
}

}  // namespace

double autocorrelation_of(const VectorXd& residual, const std::vector<FitGroup>& groups) {
  double product = 0.0, square = 0.0;
  for (const FitGroup& group : groups) {
    const auto e = residual.segment(group.first, group.size());
    square += e.squaredNorm();
    product += group.size() > 1 ? e.head(group.size() - 1).dot(e.tail(group.size() - 1)) : 0.0;
  }
  const double r = square > 0.0 ? product / square : 0.0;
  constexpr double highest = 0.999;
  return r > 2.0 / std::sqrt(double(residual.size())) ? std::min(r, highest) : 0.0;
}

double effective_size(double n, double r) { return n * (1.0 - r) / (1.0 + r); }

void state_uncertainty(SurfaceFit& fit, const FitObservations& observations,
                       const FittableModel& model, const FitSensitivity& sensitivity) {
  const double n = double(fit.residual.size());
  const double left = std::max(n - double(fit.sought), 1.0);
  fit.sigma = observations.is_u_known ? 1.0 : std::sqrt(fit.chi_squared / left);
  if (observations.is_u_known) {
    fit.p_value =
        boost::math::cdf(boost::math::complement(boost::math::chi_squared(left), fit.chi_squared));
  }
  fit.autocorrelation = autocorrelation_of(fit.residual, observations.groups);
  fit.effective_size = effective_size(n, fit.autocorrelation);
  const Knowledge knowledge = knowledge_of(sensitivity, Index(fit.parameters.size()));
  const MatrixXd covariance = knowledge.covariance * fit.sigma * fit.sigma * n / fit.effective_size;
  const double factor =
      coverage_factor(observations.is_u_known, fit.effective_size - double(fit.sought));
  constexpr double mixed_in = 0.01;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    FittedParameter& fitted = fit.parameters[i];
    fitted.low = fitted.high = fitted.value;
    if (fitted.state == State::fixed) {
      continue;
    }
    if (knowledge.unknown(Index(i)) > mixed_in) {
      fitted.state = State::open;
      fitted.u = std::numeric_limits<double>::infinity();
      fitted.low = model.parameters[i].low;
      fitted.high = model.parameters[i].high;
    } else if (sensitivity.directions.row(Index(i)).isZero()) {
      fitted.state = State::at_bound;
    } else {
      fitted.u = std::sqrt(covariance(Index(i), Index(i)));
      set_interval(fitted, model.parameters[i], factor);
    }
  }
  fit.correlation = correlation_of(covariance, fit.parameters);
}

}  // namespace gonio

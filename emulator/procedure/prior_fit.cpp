#include "emulator/procedure/prior_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A round ends when a step, or what it gains, is smaller than this, relative to all.
constexpr double round_tolerance = 1e-4;
constexpr Index most_evaluations = 100;  // of a round
/// The search ends when a round brings chi squared down by less than this, a tenth of an
/// uncertainty: what is left to gain after it is far less, and its derivatives hold where it ended.
constexpr double smallest_gain = 1e-2;
constexpr int most_rounds = 10;

/// Directions that differ in what is left by less than this share are equally unknown.
constexpr double equally_unknown = 1e-3;
constexpr double smallest_remaining = 0.5;

void expect(bool condition, const char* what) {
  if (!condition) {
    throw std::invalid_argument(fmt::format("fit_with_prior: {}", what));
  }
}

void expect_sound(const PriorFitProblem& problem) {
  expect(problem.observed.size() == problem.u_observed.size(),
         "each observation has an uncertainty");
  expect(problem.assumed.size() == problem.u_assumed.size(), "each parameter has an uncertainty");
  expect(problem.jacobian_assumed.rows() == problem.observed.size() &&
             problem.jacobian_assumed.cols() == problem.assumed.size(),
         "there is a derivative of each observation by each parameter");
  expect(problem.assumed.size() > 0, "there is a parameter");
  expect((problem.u_observed.array() > 0.0).all() && (problem.u_assumed.array() > 0.0).all(),
         "uncertainties are > 0");
}

/// The residuals of observations and priors over t, the parameters in units of their priors.
class Residuals {
 public:
  explicit Residuals(const PriorFitProblem& problem) : problem_(problem) {}

  [[nodiscard]] VectorXd parameters(const VectorXd& t) const {
    return problem_.assumed + t.cwiseProduct(problem_.u_assumed);
  }
  /// Begins with derivatives of the model that hold where it is asked for them next.
  void begin_with(const MatrixXd& jacobian) {
    const Index p = problem_.assumed.size();
    derivatives_.resize(values(), p);
    derivatives_ << problem_.u_observed.cwiseInverse().asDiagonal() * jacobian *
                        problem_.u_assumed.asDiagonal(),
        MatrixXd::Identity(p, p);
    t_before_.resize(0);
  }
  /// As they are now, shape (n + p, p).
  [[nodiscard]] const MatrixXd& derivatives() const { return derivatives_; }

  // The interface of Eigen::LevenbergMarquardt, which asks for derivatives where it was last.
  [[nodiscard]] int values() const {
    return int(problem_.observed.size() + problem_.assumed.size());
  }
  int operator()(const VectorXd& t, VectorXd& residuals) {
    residuals
        << (problem_.model(parameters(t)) - problem_.observed).cwiseQuotient(problem_.u_observed),
        t;
    residuals_ = residuals;
    return 0;
  }
  int df(const VectorXd& t, MatrixXd& derivatives) {
    if (t_before_.size() > 0) {
      correct(t - t_before_);
    }
    t_before_ = t;
    residuals_before_ = residuals_;
    derivatives = derivatives_;
    return 0;
  }

 private:
  /// The smallest change with which the derivatives explain the last step.
  void correct(const VectorXd& step) {
    const VectorXd unexplained = residuals_ - residuals_before_ - derivatives_ * step;
    derivatives_ += unexplained * step.transpose() / step.squaredNorm();
  }

  const PriorFitProblem& problem_;
  MatrixXd derivatives_;
  VectorXd residuals_, residuals_before_, t_before_;
};

/// A minimum near t, which it moves there.
/// @return  the residuals at the end.
VectorXd search_from(VectorXd& t, Residuals& residuals) {
  Eigen::LevenbergMarquardt<Residuals> search(residuals);
  search.parameters.ftol = round_tolerance;
  search.parameters.xtol = round_tolerance;
  search.parameters.maxfev = most_evaluations;
  search.useExternalScaling = true;  // the priors have scaled all parameters
  search.diag = VectorXd::Ones(t.size());
  search.minimize(t);
  return search.fvec;
}

}  // namespace

PriorFit fit_with_prior(const PriorFitProblem& problem) {
  expect_sound(problem);
  const Index p = problem.assumed.size();
  const Index n = problem.observed.size();
  Residuals residuals(problem);
  VectorXd t = VectorXd::Zero(p);
  residuals.begin_with(problem.jacobian_assumed);
  VectorXd left = search_from(t, residuals);
  bool has_converged = false;
  for (int round = 0; round < most_rounds && !has_converged; ++round) {
    const double before = left.squaredNorm();
    residuals.begin_with(problem.jacobian(residuals.parameters(t)));
    left = search_from(t, residuals);
    has_converged = before - left.squaredNorm() < smallest_gain;
  }
  const MatrixXd& derivatives = residuals.derivatives();
  const MatrixXd whitened =
      (derivatives.transpose() * derivatives).llt().solve(MatrixXd::Identity(p, p));
  PriorFit fit{
      .estimate = residuals.parameters(t),
      .covariance = problem.u_assumed.asDiagonal() * whitened * problem.u_assumed.asDiagonal(),
      .residual = -left.head(n).cwiseProduct(problem.u_observed),
      .chi_squared = left.squaredNorm(),
      .has_converged = has_converged};
  fit.p_value = n == 0 ? 1.0
                       : boost::math::cdf(boost::math::complement(
                             boost::math::chi_squared(double(n)), fit.chi_squared));
  return fit;
}

std::vector<Confusion> confusions_of(const MatrixXd& covariance, const VectorXd& prior) {
  const Index p = prior.size();
  const VectorXd per_prior = prior.cwiseInverse();
  const MatrixXd whitened = per_prior.asDiagonal() * covariance * per_prior.asDiagonal();
  // Directions of equal eigenvalues are any; a slope along the diagonal makes them the axes.
  const VectorXd slope = VectorXd::LinSpaced(p, equally_unknown, 0.0);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(whitened + MatrixXd(slope.asDiagonal()));
  std::vector<Confusion> confusions;
  for (Index i = p; i-- > 0;) {
    VectorXd direction = solver.eigenvectors().col(i);
    const double remaining = std::sqrt(std::min(1.0, direction.dot(whitened * direction)));
    if (remaining <= smallest_remaining) {
      continue;
    }
    Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    direction *= std::copysign(1.0, direction(largest));
    confusions.push_back(
        {.direction = {direction.begin(), direction.end()}, .remaining = remaining});
  }
  return confusions;
}

}  // namespace gonio

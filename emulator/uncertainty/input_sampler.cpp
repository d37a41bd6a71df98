#include "emulator/uncertainty/input_sampler.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "emulator/uncertainty/normal_quantile.hpp"
#include "emulator/uncertainty/random.hpp"

namespace gonio {

namespace {

using Shape = Distribution::Shape;
using Column = Eigen::Ref<Eigen::ArrayXd>;

constexpr std::uint64_t main_stream = 0;
constexpr std::uint64_t angle_stream = 1;  // of Student's second draw

std::span<double> span_of(Column column) { return {column.data(), std::size_t(column.size())}; }

/// Replaces uniform draws by those of half width 1.
void to_bounded(Shape shape, Column p) {
  if (shape == Shape::rectangular) {
    p = 2.0 * p - 1.0;
  } else if (shape == Shape::triangular) {
    p = (p < 0.5).select((2.0 * p).sqrt() - 1.0, 1.0 - (2.0 - 2.0 * p).sqrt());
  } else {
    p = (std::numbers::pi * (p - 0.5)).sin();
  }
}

/// Replaces uniform draws by those of Student's t of scale 1, for any degrees of freedom nu > 0:
///
///   t = sqrt(nu (p^(-2/nu) - 1)) cos(2 pi q)
///
/// @see Bailey, Polar generation of random variates with the t-distribution, 1994
void to_student(double nu, const Eigen::ArrayXd& q, Column p) {
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    p(i) = std::sqrt(nu * std::expm1(-2.0 / nu * std::log(p(i)))) *
           std::cos(2.0 * std::numbers::pi * q(i));
  }
}

}  // namespace

InputSampler::InputSampler(const InputSet& inputs, std::uint64_t seed)
    : inputs_(inputs), seed_(seed) {
  inputs.expect_positive_definite();
  const Eigen::MatrixXd r = inputs.correlation();
  for (Eigen::Index i = 0; i < r.rows(); ++i) {
    if ((r.row(i).array() != 0.0).count() > 1) {
      correlated_.push_back(i);
    }
  }
  cholesky_ = r(correlated_, correlated_).llt().matrixL();
}

void InputSampler::correlate(Eigen::ArrayXXd& x) const {
  for (std::size_t i = correlated_.size(); i-- > 0;) {  // the last first: it needs those before it
    const auto row = Eigen::Index(i);
    auto column = x.col(correlated_[i]);
    column *= cholesky_(row, row);
    for (Eigen::Index k = 0; k < row; ++k) {
      if (cholesky_(row, k) != 0.0) {
        column += cholesky_(row, k) * x.col(correlated_[std::size_t(k)]);
      }
    }
  }
}

void InputSampler::draw(std::uint64_t first_trial, Eigen::ArrayXXd& x) const {
  uniform_draws(seed_, main_stream, first_trial, x);
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const Distribution& distribution = inputs_.inputs()[std::size_t(j)].distribution;
    if (std::isfinite(distribution.half_width())) {
      to_bounded(distribution.shape, x.col(j));
    } else if (std::isfinite(distribution.degrees_of_freedom)) {
      Eigen::ArrayXd angle(x.rows());
      uniform_draws_of(std::uint64_t(j), seed_, angle_stream, first_trial, span_of(angle));
      to_student(distribution.degrees_of_freedom, angle, x.col(j));
    } else {
      to_normal_quantile(span_of(x.col(j)));
    }
  }
  correlate(x);
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const InputQuantity& input = inputs_.inputs()[std::size_t(j)];
    const double half_width = input.distribution.half_width();
    const double scale =
        std::isfinite(half_width) ? half_width : input.distribution.standard_uncertainty;
    x.col(j) = input.estimate + scale * x.col(j);
  }
}

}  // namespace gonio

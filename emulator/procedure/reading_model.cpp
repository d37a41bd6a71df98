#include "emulator/procedure/reading_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the box that polynomials are fitted in, in standard uncertainties. Of a normal distribution 6
/// draws of 100,000 lie beyond; as if at its edge, they take a ten-thousandth off its uncertainty.
constexpr double reach = 4.0;
/// Of a polynomial, in GU: where it errs by more, the optics themselves are read.
constexpr double largest_error_gu = 1e-3;
/// Asked of the integrator where it reads trials one by one, in GU.
constexpr double direct_tolerance = 1e-4;

/// The values of the components of one geometry.
template <class Values>
std::array<double, uncertainty_component_count> components_of(const GeometryInputs& inputs,
                                                              const Values& x) {
  std::array<double, uncertainty_component_count> d{};
  for (std::size_t i = 0; i < d.size(); ++i) {
    d[i] = x(Index(inputs.component_index[i]));
  }
  return d;
}

double reach_of(const Distribution& distribution) {
  return std::min(distribution.half_width(), reach * distribution.standard_uncertainty);
}

}  // namespace

ReadingModel::ReadingModel(const Instrument& instrument, const InputSet& set, GeometryInputs inputs,
                           const std::vector<Sample>& samples, double tolerance)
    : set_(set),
      inputs_(std::move(inputs)),
      samples_(samples),
      optics_(instrument, inputs_.geometry, samples, tolerance),
      equation_(measurement_equation(instrument, inputs_.geometry)) {
  for (const std::size_t place : inputs_.setup_index) {
    optical_index_.push_back(Index(place));
  }
  for (const auto component :
       {UncertaintyComponent::polarization, UncertaintyComponent::spectral_mismatch}) {
    optical_index_.push_back(Index(inputs_.component_index[std::size_t(component)]));
  }
}

VectorXd ReadingModel::estimates() const {
  VectorXd x(Index(set_.size()));
  for (std::size_t i = 0; i < set_.size(); ++i) {
    x[Index(i)] = set_.inputs()[i].estimate;
  }
  return x;
}

const InputQuantity& ReadingModel::optical_input(Index parameter) const {
  return set_.inputs()[std::size_t(optical_index_[std::size_t(parameter)])];
}

VectorXd ReadingModel::optical_part(const VectorXd& x) const { return x(optical_index_); }

VectorXd ReadingModel::of_optics(const VectorXd& g, const VectorXd& x) const {
  const auto d = components_of(inputs_, x);
  return g.unaryExpr([&](double optical) { return equation_.reading(optical, d); });
}

VectorXd ReadingModel::operator()(const VectorXd& x) const {
  return of_optics(optics_(optical_part(x)), x);
}

MatrixXd ReadingModel::jacobian() const {
  const VectorXd x = estimates();
  VectorXd steps(optics_.size());
  for (Index i = 0; i < steps.size(); ++i) {
    steps[i] = optical_input(i).distribution.standard_uncertainty;
  }
  const VectorXd g = optics_(optical_part(x));
  const MatrixXd of_optical = optics_.jacobian(optical_part(x), steps);
  const auto d = components_of(inputs_, x);
  MatrixXd result = MatrixXd::Zero(g.size(), Index(set_.size()));
  for (Index s = 0; s < g.size(); ++s) {
    const MeasurementEquation::Gradient gradient = equation_.gradient(g[s], d);
    for (std::size_t i = 0; i < d.size(); ++i) {
      result(s, Index(inputs_.component_index[i])) = gradient.by_component[i];
    }
    for (std::size_t i = 0; i < optical_index_.size(); ++i) {
      result(s, optical_index_[i]) = gradient.by_optics * of_optical(s, Index(i));
    }
  }
  return result;
}

MatrixXd ReadingModel::secants() const {
  const VectorXd x = estimates();
  MatrixXd result = MatrixXd::Zero(Index(samples_.size()), x.size());
  std::vector<std::size_t> places = inputs_.setup_index;
  places.insert(places.end(), inputs_.component_index.begin(), inputs_.component_index.end());
  parallel_for(places.size(), [&](std::size_t i) {
    const double u = set_.inputs()[places[i]].distribution.standard_uncertainty;
    if (u > 0.0) {
      VectorXd up = x, down = x;
      up[Index(places[i])] += u;
      down[Index(places[i])] -= u;
      result.col(Index(places[i])) = ((*this)(up) - (*this)(down)) / (2.0 * u);
    }
  });
  return result;
}

void ReadingModel::fit(std::uint64_t seed) {
  VectorXd half_width(optics_.size());
  for (Index i = 0; i < half_width.size(); ++i) {
    half_width[i] = reach_of(optical_input(i).distribution);
  }
  surrogate_ = PolynomialSurrogate::fit(optics_, optical_part(estimates()), half_width,
                                        {.target_error = largest_error_gu / 2, .seed = seed});
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    if (!(surrogate_->error()[Index(s)] < largest_error_gu)) {
      direct_.push_back(s);
      direct_optics_.push_back(optics_.of_sample(s).with_tolerance(direct_tolerance));
    }
  }
}

void ReadingModel::evaluate(const ArrayXXd& x, Eigen::Ref<ArrayXXd> y) const {
  const ArrayXXd parameters = x(Eigen::all, optical_index_);
  ArrayXXd g;
  surrogate_->evaluate(parameters, g);
  of_optics(g, x, y);
}

void ReadingModel::evaluate_directly(const ArrayXXd& x, Eigen::Ref<ArrayXXd> y) const {
  const ArrayXXd parameters = x(Eigen::all, optical_index_);
  ArrayXXd g(x.rows(), Index(direct_.size()));
  for (Index t = 0; t < x.rows(); ++t) {
    for (std::size_t i = 0; i < direct_optics_.size(); ++i) {
      g(t, Index(i)) = direct_optics_[i](parameters.row(t).matrix().transpose())[0];
    }
  }
  of_optics(g, x, y);
}

void ReadingModel::of_optics(const ArrayXXd& g, const ArrayXXd& x, Eigen::Ref<ArrayXXd>& y) const {
  for (Index t = 0; t < x.rows(); ++t) {
    const auto d = components_of(inputs_, x.row(t));
    const double gain = equation_.gain(d);
    for (Index s = 0; s < g.cols(); ++s) {
      y(t, s) = equation_.reading(gain, g(t, s), d);
    }
  }
}

}  // namespace gonio

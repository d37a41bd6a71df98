#include "emulator/goniometry/model_responses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace gonio {

namespace {

using Eigen::VectorXd;

/// Steps of the logarithm of a shape: nodes are at 2^(step / 8).
constexpr double step_length = std::numbers::ln2 / 8.0;
constexpr int points = 6;

}  // namespace

ModelResponses::ModelResponses(const FitObservations& observations, FittableModel model,
                               Eigen::ArrayXcd n_hat)
    : grid_(observations.grid),
      respond_(observations.respond),
      model_(std::move(model)),
      n_hat_(std::move(n_hat)) {}

VectorXd ModelResponses::computed(std::size_t term, const FitValues& values) const {
  const auto index = values.find(index_parameter);
  return respond_(model_.terms[term].surface(
      grid_,
      index == values.end() ? n_hat_ : Eigen::ArrayXcd::Constant(n_hat_.size(), index->second),
      values));
}

const VectorXd& ModelResponses::node(std::size_t term, const std::string& shape, int step) {
  const auto found = nodes_.find({term, step});
  if (found != nodes_.end()) {
    return found->second;
  }
  return nodes_
      .emplace(std::pair(term, step), computed(term, {{shape, std::exp(step * step_length)}}))
      .first->second;
}

VectorXd ModelResponses::interpolated(std::size_t term, const FitParameter& shape, double value) {
  const double x = std::log(value) / step_length;
  constexpr double on_node = 1e-9;
  if (std::abs(x - std::round(x)) < on_node) {
    return node(term, shape.name, int(std::lround(x)));
  }
  const int lowest = int(std::ceil(std::log(shape.low) / step_length - on_node));
  const int highest = int(std::floor(std::log(shape.high) / step_length + on_node));
  const int first = std::clamp(int(std::floor(x)) - points / 2 + 1, lowest, highest - points + 1);
  VectorXd sum;
  for (int i = first; i < first + points; ++i) {
    double weight = 1.0;
    for (int j = first; j < first + points; ++j) {
      weight *= j == i ? 1.0 : (x - j) / double(i - j);
    }
    const VectorXd& at = node(term, shape.name, i);
    sum = sum.size() == 0 ? VectorXd(weight * at) : VectorXd(sum + weight * at);
  }
  return sum;
}

const VectorXd& ModelResponses::of(std::size_t term, const FitValues& values) {
  Key key{term, {}};
  const std::vector<std::string>& shapes = model_.terms[term].shape;
  for (const std::string& name : shapes) {
    key.second.push_back(values.at(name));
  }
  const auto known = known_.find(key);
  if (known != known_.end()) {
    return known->second;
  }
  VectorXd response;
  if (shapes.size() == 1) {
    const auto shape = std::ranges::find(model_.parameters, shapes[0], &FitParameter::name);
    response = interpolated(term, *shape, key.second[0]);
  } else {
    response = computed(term, values);
  }
  return known_.emplace(std::move(key), std::move(response)).first->second;
}

}  // namespace gonio

// A million trials of as many inputs as an instrument of three geometries has.

#include <benchmark/benchmark.h>

#include "emulator/uncertainty/monte_carlo.hpp"

namespace gonio::bench {

namespace {

using Shape = Distribution::Shape;

constexpr int geometries = 3;
constexpr int inputs_of_each = 15;

/// Two correlated angles, one input of Student's, three bounded ones, the others normal.
InputSet inputs() {
  InputSet result;
  for (int i = 0; i < geometries * inputs_of_each; ++i) {
    Distribution distribution{.standard_uncertainty = 0.01};
    if (i % inputs_of_each == 2) {
      distribution.degrees_of_freedom = 9.0;
    } else if (i % inputs_of_each >= inputs_of_each - 3) {
      distribution = Distribution::bounded(Shape(2 + i % 3), 0.1);
    }
    result.add({.id = "x", .estimate = 1.0, .distribution = distribution});
  }
  for (std::size_t i = 0; i < geometries; ++i) {
    result.correlate(i * inputs_of_each, i * inputs_of_each + 1, 0.5);
  }
  return result;
}

void a_million_trials(benchmark::State& state) {
  const InputSet all = inputs();
  const auto n_outputs = std::size_t(state.range(0));
  const BatchModel model = [](const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) {
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      y.col(j) = x.col(j) * x.col(j + 1);
    }
  };
  for (auto _ : state) {
    benchmark::DoNotOptimize(monte_carlo(all, n_outputs, model, {.trials = 1'000'000}));
  }
}
BENCHMARK(a_million_trials)->Arg(1)->Arg(36)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench

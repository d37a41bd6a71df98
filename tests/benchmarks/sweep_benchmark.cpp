// A sweep over many samples on two threads against one.

#include <tbb/global_control.h>

#include "emulator/procedure/measure.hpp"
#include "emulator/surface/models.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/data.hpp"

namespace gonio::bench {

namespace {

constexpr double target = 1.9;
constexpr int sample_count = 256;

/// Black paints of growing roughness.
std::vector<Sample> samples(const WavelengthGrid& grid) {
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(grid.size(), 1.5);
  std::vector<Sample> result;
  result.reserve(sample_count);
  for (int j = 0; j < sample_count; ++j) {
    result.push_back({.file = {}, .surface = cook_torrance(grid, 0.02 + 0.00125 * j, n_hat)});
  }
  return result;
}

void two_threads_against_one(benchmark::State& state) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const std::vector<Sample> all = samples(grid);
  const Glossmeter glossmeter = nominal_glossmeter(grid);
  const Observer observer = Observer::load(catalog().fixture("observers/cie_1931_2deg.csv"), grid);
  const auto measure_on = [&](std::size_t threads) {
    return [&, threads] {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      benchmark::DoNotOptimize(measure_all(all, glossmeter, observer, {}));
    };
  };
  compare(state, speedup_at_least(target), measure_on(1), measure_on(2), Clock::elapsed);
}
BENCHMARK(two_threads_against_one)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench

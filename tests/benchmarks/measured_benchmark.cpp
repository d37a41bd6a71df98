// Measured BRDFs: evaluation per direction, reading, and the gloss of a sample of MERL.

#include <stdlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "emulator/measured/merl_brdf.hpp"
#include "emulator/measured/rgl_brdf.hpp"
#include "emulator/measured/rgl_writer.hpp"
#include "emulator/procedure/measure.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/data.hpp"

namespace gonio::bench {

namespace {

using Eigen::Index;

/// A new folder, removed at the end of the program.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "gonio_bench_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path path;
};

std::filesystem::path scratch(const std::string& name) {
  static const Scratch folder;
  return folder.path / name;
}

/// A file of MERL in its size, 33.3 MB: a lobe, and with_gaps a quarter that was not measured.
std::filesystem::path merl_file(bool with_gaps) {
  constexpr int counts[3]{90, 90, 180};
  std::string bytes(12 + 3 * std::size_t{90} * 90 * 180 * 8, '\0');
  std::memcpy(bytes.data(), counts, 12);
  char* at = bytes.data() + 12;
  for (int channel = 0; channel < 3; ++channel) {
    for (int h = 0; h < counts[0]; ++h) {
      const double value = 100.0 + 20000.0 * std::exp(-1e-3 * h * h);
      for (int node = 0; node < counts[1] * counts[2]; ++node, at += 8) {
        const double stored = with_gaps && h >= 45 && node >= 8100 ? -1.0 : value;
        std::memcpy(at, &stored, 8);
      }
    }
  }
  const std::filesystem::path path = scratch(with_gaps ? "gaps.binary" : "whole.binary");
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Directions evenly spread over the hemisphere, on a spiral.
DirectionBatch spiral(Index n) {
  constexpr double turn = 2.399963229728653;  // golden angle
  DirectionBatch omega;
  omega.resize(n);
  for (Index j = 0; j < n; ++j) {
    omega.z(j) = (double(j) + 0.5) / double(n);
    const double sin_theta = std::sqrt(1.0 - omega.z(j) * omega.z(j));
    omega.x(j) = sin_theta * std::cos(turn * double(j));
    omega.y(j) = sin_theta * std::sin(turn * double(j));
  }
  return omega;
}

void evaluate(benchmark::State& state, const MeasuredBrdf& brdf) {
  const DirectionBatch omega_r = spiral(4096);
  Eigen::ArrayXXd f_r(omega_r.size(), Index(brdf.channels().size()));
  const Vector3 omega_i(-std::sqrt(0.75), 0.0, 0.5);
  for ([[maybe_unused]] auto turn : state) {
    brdf.evaluate(omega_i, omega_r, f_r);
    benchmark::DoNotOptimize(f_r.data());
  }
  state.SetItemsProcessed(int64_t(state.iterations()) * omega_r.size());
  state.counters["s_per_direction"] =
      benchmark::Counter(double(state.iterations()) * double(omega_r.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const std::filesystem::path satin =
    std::filesystem::path(GONIO_SOURCE_DIR) / "fixtures/brdf/satin_rosaline_rgb.bsdf";

void rgl_evaluation(benchmark::State& state) { evaluate(state, *read_rgl(satin).brdf); }
BENCHMARK(rgl_evaluation);

void merl_evaluation(benchmark::State& state) {
  evaluate(state, *read_merl(merl_file(false)).brdf);
}
BENCHMARK(merl_evaluation);

void rgl_reading(benchmark::State& state) {
  for ([[maybe_unused]] auto turn : state) {
    benchmark::DoNotOptimize(read_rgl(satin).brdf.get());
  }
}
BENCHMARK(rgl_reading)->Unit(benchmark::kMillisecond);

/// The whole way of `gonio measure`: the file of 33 MB, three geometries, what its step may cost.
void merl_gloss(benchmark::State& state) {
  const std::filesystem::path path = merl_file(false);
  const std::filesystem::path sample = scratch("merl.yaml");
  std::ofstream(sample) << "schema: gonio/sample/1\nid: merl\ntitle: A lobe\nsurface: {model: "
                           "measured, file: "
                        << path.filename().string() << "}\n";
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Glossmeter glossmeter = nominal_glossmeter(grid);
  const Observer observer = Observer::load(catalog().fixture("observers/cie_1931_2deg.csv"), grid);
  for ([[maybe_unused]] auto turn : state) {
    benchmark::DoNotOptimize(measure(load_sample(sample, grid), glossmeter, observer, {}));
  }
}
BENCHMARK(merl_gloss)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Argument: whether a quarter of the numbers has to be filled in.
void merl_reading(benchmark::State& state) {
  const std::filesystem::path path = merl_file(state.range(0) != 0);
  for ([[maybe_unused]] auto turn : state) {
    benchmark::DoNotOptimize(read_merl(path).brdf.get());
  }
}
BENCHMARK(merl_reading)->ArgName("gaps")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void rgl_writing(benchmark::State& state) {
  const BrdfFile source = read_rgl(satin);
  for ([[maybe_unused]] auto turn : state) {
    write_rgl(scratch("written.bsdf"), *source.brdf);
  }
}
BENCHMARK(rgl_writing)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench

// Reflectance of polished copper into the hemisphere by 196,608 patches at 81 wavelengths, against
// evaluating the geometry of its lobe once for each patch.

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/patch_integrator.hpp"
#include "emulator/surface/shape_kernels.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/data.hpp"
#include "tests/benchmarks/plain_lobe.hpp"

namespace gonio::bench {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double target = 3.0;
constexpr Index resolution = 256;  // 3 * 256^2 = 196,608 patches
constexpr double rms_slope = 0.065;

Vector3 incident() { return source_frame(degrees(60)).axis; }

/// Calls use(frame, u, v) for each row of the hemicube: u of its patches, and v of the row.
template <class Use>
void for_each_row(Use use) {
  const double step = 2.0 / double(resolution);
  const ArrayXd u = ArrayXd::LinSpaced(resolution, -1.0 + 0.5 * step, 1.0 - 0.5 * step);
  for (const Aperture& face : hemicube_faces()) {
    for (double v = face.v_low() + 0.5 * step; v < face.v_high(); v += step) {
      use(face.frame(), u, v);
    }
  }
}

/// The sum of g over all patches, one at a time.
double plain_lobe() {
  const Vector3 omega_i = incident();
  double sum = 0.0;
  for_each_row([&](const Frame& frame, const ArrayXd& u, double v) {
    for (const double u_of_patch : u) {
      sum += plain_cook_torrance(rms_slope, omega_i, frame.direction(u_of_patch, v));
    }
  });
  return sum;
}

/// The same, a row at a time.
double batched_lobe() {
  const Vector3 omega_i = incident();
  DirectionBatch omega_r;
  omega_r.resize(resolution);
  ArrayXd g(resolution);
  ArrayXd projected(resolution);
  ArrayXd vs(resolution);
  double sum = 0.0;
  for_each_row([&](const Frame& frame, const ArrayXd& u, double v) {
    vs.setConstant(v);
    projected.setOnes();
    kernel::tangent_directions(frame, u, vs, omega_r, projected);
    kernel::beckmann_v_groove(rms_slope, omega_i, omega_r, g);
    sum += g.sum();
  });
  return sum;
}

template <class Lobe>
void compare_with(benchmark::State& state, Lobe lobe) {
  const Sample copper = sample("copper_polished", WavelengthGrid::visible());
  const PatchIntegrator integrator(resolution);
  const Index count = copper.surface.grid.size();
  const ArrayXd weight = ArrayXd::Constant(count, 1.0 / double(count));
  compare(
      state, cost_at_most(target), [&] { benchmark::DoNotOptimize(lobe()); },
      [&] {
        constexpr double unused_tolerance = 1.0;
        const Flux flux =
            integrator.hemispherical(copper.surface, incident(), weight, unused_tolerance);
        benchmark::DoNotOptimize(flux.spectral.data());
      });
}

void against_batched_lobe(benchmark::State& state) { compare_with(state, batched_lobe); }
BENCHMARK(against_batched_lobe)->Unit(benchmark::kMillisecond);

void against_plain_lobe(benchmark::State& state) { compare_with(state, plain_lobe); }
BENCHMARK(against_plain_lobe)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench

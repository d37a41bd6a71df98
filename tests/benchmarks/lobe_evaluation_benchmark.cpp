// Batched kernels of lobes against the same formulas for one pair of directions at a time.

#include <fmt/format.h>

#include <stdexcept>

#include "emulator/surface/shape_kernels.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/plain_lobe.hpp"

namespace gonio::bench {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double target = 5.0;
constexpr double roughness = 0.3;
constexpr Index incident_count = 64;
/// The two ways differ by the rounding of a few operations, which the exponent multiplies by up to
/// tan(60 deg)^2 / roughness^2 = 33.
constexpr double agreement = 1e-12;

using PlainLobe = double (*)(double, const Vector3&, const Vector3&);
using BatchedLobe = void (*)(double, const Vector3&, const DirectionBatch&, Eigen::Ref<ArrayXd>);

/// n directions evenly spread within 60 deg of the normal, on a spiral: no exponential underflows,
/// which std::exp would be slow at.
std::vector<Vector3> spiral(Index n) {
  constexpr double turn = 2.399963229728653;  // golden angle
  std::vector<Vector3> omega;
  for (Index j = 0; j < n; ++j) {
    const double cos_theta = 1.0 - 0.5 * (double(j) + 0.5) / double(n);
    const double sin_theta = std::sqrt(1.0 - cos_theta * cos_theta);
    const double phi = turn * double(j);
    omega.emplace_back(sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta);
  }
  return omega;
}

DirectionBatch as_batch(const std::vector<Vector3>& omega) {
  DirectionBatch batch;
  batch.resize(Index(omega.size()));
  for (Index j = 0; j < batch.size(); ++j) {
    const Vector3& direction = omega[std::size_t(j)];
    batch.x(j) = direction.x();
    batch.y(j) = direction.y();
    batch.z(j) = direction.z();
  }
  return batch;
}

void expect_equal(const ArrayXd& plain, const ArrayXd& batched) {
  const double worst = ((batched - plain) / plain).abs().maxCoeff();
  if (!(worst <= agreement)) {
    throw std::runtime_error(
        fmt::format("the batched lobe differs from the plain one by {:.2e} relative", worst));
  }
}

/// One turn: 64 directions of incidence with state.range(0) directions of reflection each. The
/// plain lobe is a template argument, so that the compiler can inline it into the loop.
template <PlainLobe plain_lobe, BatchedLobe batched_lobe>
void evaluate(benchmark::State& state) {
  const std::vector<Vector3> incident = spiral(incident_count);
  const std::vector<Vector3> reflected = spiral(Index(state.range(0)));
  const DirectionBatch batch = as_batch(reflected);
  ArrayXd plain(batch.size());
  ArrayXd batched(batch.size());
  const auto evaluate_plain = [&](const Vector3& omega_i) {
    for (std::size_t j = 0; j < reflected.size(); ++j) {
      plain(Index(j)) = plain_lobe(roughness, omega_i, reflected[j]);
    }
    benchmark::DoNotOptimize(plain.data());
  };
  const auto evaluate_batched = [&](const Vector3& omega_i) {
    batched_lobe(roughness, omega_i, batch, batched);
    benchmark::DoNotOptimize(batched.data());
  };
  for (const Vector3& omega_i : incident) {
    evaluate_plain(omega_i);
    evaluate_batched(omega_i);
    expect_equal(plain, batched);
  }
  const auto for_all = [&](const auto& use) {
    return [&] { std::for_each(incident.begin(), incident.end(), use); };
  };
  compare(state, speedup_at_least(target), for_all(evaluate_plain), for_all(evaluate_batched));
}

void cook_torrance(benchmark::State& state) {
  evaluate<plain_cook_torrance, kernel::beckmann_v_groove>(state);
}
BENCHMARK(cook_torrance)->ArgName("directions")->Arg(256)->Arg(4096);

void ggx(benchmark::State& state) { evaluate<plain_ggx, kernel::ggx_height_correlated>(state); }
BENCHMARK(ggx)->ArgName("directions")->Arg(256)->Arg(4096);

}  // namespace

}  // namespace gonio::bench

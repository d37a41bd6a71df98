// Readings of the whole ladder by many set-ups: through the optics, and by the polynomial that
// stands for them in a Monte Carlo of a certificate.

#include <algorithm>

#include "emulator/procedure/certify.hpp"
#include "emulator/procedure/optical_response.hpp"
#include "emulator/procedure/polynomial_surrogate.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/data.hpp"

namespace gonio::bench {

namespace {

constexpr double target = 1000.0;
constexpr Eigen::Index setup_count = 128;
constexpr double half_width = 0.025;  // of the box, in deg: five standard uncertainties

void surrogate_against_optics(benchmark::State& state) {
  const std::vector<Sample> ladder = effect_ladder(WavelengthGrid::visible());
  const OpticalResponse response(
      load_instrument(catalog().find(Catalog::Kind::instrument, "triangle_gloss"), catalog()), "60",
      ladder, 1e-6);
  const Eigen::VectorXd box = Eigen::VectorXd::Constant(response.size(), half_width);
  const auto surrogate = PolynomialSurrogate::fit(response, response.as_built(), box, {});
  const Eigen::ArrayXXd setups =
      (half_width * Eigen::ArrayXXd::Random(setup_count, response.size())).rowwise() +
      response.as_built().transpose().array();
  Eigen::ArrayXXd gloss_gu(setup_count, Eigen::Index(ladder.size()));
  compare(
      state, speedup_at_least(target),
      [&] {
        for (Eigen::Index i = 0; i < setup_count; ++i) {
          gloss_gu.row(i) = response(setups.row(i).transpose().matrix()).transpose().array();
        }
        benchmark::DoNotOptimize(gloss_gu.data());
      },
      [&] {
        surrogate.evaluate(setups, gloss_gu);
        benchmark::DoNotOptimize(gloss_gu.data());
      });
  state.counters["degree"] = surrogate.degree();
  state.counters["error_gu"] = surrogate.error().maxCoeff();
}
BENCHMARK(surrogate_against_optics)->Unit(benchmark::kMillisecond);

/// A whole certificate of three geometries and the ladder, with a million trials of Monte Carlo,
/// against what the same trials would take through the optics, one reading of which is timed.
void million_instruments(benchmark::State& state) {
  constexpr double trials = 1e6;
  constexpr double at_most_s = 10.0;
  const Instrument instrument =
      load_instrument(catalog().find(Catalog::Kind::instrument, "triangle_gloss"), catalog());
  const ClauseSet clauses =
      load_clauses(catalog().find(Catalog::Kind::clauses, "iso_2813/2014"), catalog());
  const std::vector<Sample> ladder = effect_ladder(WavelengthGrid::visible());
  std::vector<OpticalResponse> optics;
  for (const std::string& id : instrument.geometries) {
    optics.emplace_back(instrument, id, ladder, CertifyOptions{}.tolerance);
  }
  double error_gu = 0.0;
  compare(
      state, speedup_at_least(target),
      [&] {
        for (const OpticalResponse& response : optics) {
          benchmark::DoNotOptimize(response(response.as_built()));
        }
      },
      [&] {
        const Certificate certificate =
            certify(instrument, clauses, ladder, {.trials = std::size_t(trials)});
        for (const GeometryCertificate& geometry : certificate.geometries) {
          error_gu = std::max(error_gu, *std::ranges::max_element(geometry.surrogate_error_gu));
        }
      },
      Clock::elapsed);
  state.counters["ratio"] = trials * state.counters["ratio"].value;
  state.counters["at_most_s"] = at_most_s;
  state.counters["error_gu"] = error_gu;
}
BENCHMARK(million_instruments)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

}  // namespace gonio::bench

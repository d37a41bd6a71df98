// A scan of 10,000 positions at 81 wavelengths: half a goniometer's day.

#include <benchmark/benchmark.h>

#include "emulator/goniometry/scan.hpp"
#include "tests/benchmarks/data.hpp"

namespace gonio::bench {

namespace {

/// 5 angles of incidence, 40 polar angles and 50 azimuths of the receptor.
ScanPlan ten_thousand_positions() {
  ScanPlan plan;
  plan.theta_i = *parse_angles("10 deg, 25 deg, 40 deg, 55 deg, 70 deg");
  plan.theta_r = *parse_angles("2:80:2 deg");
  plan.phi_r = *parse_angles("0:352.8:7.2 deg");
  plan.source = plan.receptor = *parse_opening("2 deg");
  plan.heads_apart = {};
  return plan;
}

void scan_of(benchmark::State& state, const char* id, UseOfReciprocity reciprocity) {
  ScanPlan plan = ten_thousand_positions();
  plan.reciprocity = reciprocity;
  const Sample painted = sample(id, plan.grid);
  const ScanLight light = scan_light(plan, catalog());
  std::size_t positions = 0;
  std::size_t missed = 0;
  for (auto _ : state) {
    const ScanResult result = scan(painted, plan, light);
    positions = result.evaluations;
    missed = result.missed;
  }
  state.counters["evaluations"] = double(positions);
  state.counters["missed"] = double(missed);
}
BENCHMARK_CAPTURE(scan_of, matt, "white_matt_wall_paint", UseOfReciprocity::no)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(scan_of, satin, "red_satin", UseOfReciprocity::no)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(scan_of, copper, "copper_polished", UseOfReciprocity::no)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(scan_of, brushed_steel, "steel_brushed", UseOfReciprocity::no)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace

}  // namespace gonio::bench

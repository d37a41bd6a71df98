#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/unit/reports/example_qa.hpp"

// Runs of a store made up for the tests of their writers: two batches with the same limits of one
// channel, all verdicts, a run that is not finished. Their numbers are nobody's.

namespace gonio::test {

inline ChannelTrend example_trend(std::uint32_t channel, double mean, double sigma) {
  return {.channel = channel,
          .panels = 40,
          .readings = 120,
          .mean = mean,
          .standard_deviation = sigma,
          .low = {},
          .high = {},
          .cpk = {},
          .ppk = {}};
}

inline StoredRun example_stored_run(std::int64_t id, ConformanceVerdict verdict, double mean) {
  StoredRun run{.record = example_run()};
  run.record.id = id;
  run.record.started = fmt::format("2026-01-{:02}T08:00:00Z", 10 + id);
  ChannelTrend gloss = example_trend(0, mean, 0.8);
  gloss.low = 57.0;
  gloss.high = 63.0;
  gloss.cpk = rounded((63.0 - mean) / 2.4);
  gloss.ppk = rounded((63.0 - mean) / 2.7);
  run.outcome = RunOutcome{
      .verdict = verdict,
      .finished = fmt::format("2026-01-{:02}T08:05:00Z", 10 + id),
      .panels = 40,
      .readings = 240,
      .producer_risk = 0.021,
      .consumer_risk = 0.009,
      .channels = {gloss, example_trend(1, rounded(0.4 + 0.01 * wobble(std::uint64_t(id))), 0.14)}};
  return run;
}

inline std::vector<StoredRun> example_history() {
  using enum ConformanceVerdict;
  std::vector<StoredRun> runs;
  for (std::int64_t id = 1; id <= 12; ++id) {
    const double mean = rounded(60.0 + 0.25 * wobble(std::uint64_t(id)) + (id == 9 ? 2.6 : 0.0));
    runs.push_back(example_stored_run(id, id == 9 ? fail : id == 5 ? inconclusive : pass, mean));
  }
  runs[10].record.kind = RunRecord::Kind::measured;
  runs.push_back(example_stored_run(13, pass, 60.2));
  runs.back().record.batch = "coil_coating_next";
  runs.back().outcome->producer_risk.reset();
  runs.push_back(example_stored_run(14, pass, 60.1));
  runs.back().outcome.reset();
  return runs;
}

}  // namespace gonio::test

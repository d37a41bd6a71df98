#pragma once

#include <string>
#include <vector>

#include "tests/unit/reports/example_history.hpp"
#include "tests/unit/reports/hostile_report.hpp"

// The examples with texts that want to be more than text, wherever a text can stand.

namespace gonio::test {

inline void spoil(BatchChannel& channel, const std::string& text) {
  channel.id = channel.geometry = channel.unit = text;
}

inline void spoil(RunRecord& run, const std::string& text) {
  run.batch = run.title = run.batch_file = run.batch_text = run.fingerprint = text;
  run.gonio_version = run.standard = run.started = text;
  run.sample = run.readings = {text, text};
  for (HashedFile& instrument : run.instruments) {
    instrument = {text, text};
  }
  for (std::string& name : run.operators) {
    name = text;
  }
  for (BatchChannel& channel : run.channels) {
    spoil(channel, text);
  }
}

inline QaResult hostile_qa(const std::string& text) {
  QaResult result = example_qa();
  spoil(result.run, text);
  result.store = result.decision = result.acceptance = text;
  for (ChannelSummary& channel : result.channels) {
    spoil(channel.channel, text);
  }
  for (ChannelGauge& gauge : result.gauge) {
    for (std::string& appraiser : gauge.appraisers) {
      appraiser = text;
    }
  }
  for (OcCurve& curve : result.oc_curves) {
    curve.parameter = curve.closed_form = text;
  }
  for (SpreadAnswer& answer : result.spread_answers) {
    answer.parameter = text;
  }
  result.remarks = {text, text};
  return result;
}

inline std::vector<StoredRun> hostile_history(const std::string& text) {
  std::vector<StoredRun> runs = example_history();
  for (StoredRun& run : runs) {
    spoil(run.record, text);
    if (run.outcome) {
      run.outcome->finished = text;
    }
  }
  return runs;
}

inline PanelRecord example_panel(std::uint64_t number, const std::string& label) {
  PanelRecord panel{.number = number, .lot = 2, .label = label};
  for (std::uint32_t position = 1; position <= 2; ++position) {
    panel.readings.push_back({.channel = 0,
                              .position = position,
                              .repetition = 1,
                              .instrument = 1,
                              .operator_ = 1,
                              .value = 60.1 + position});
  }
  panel.channels = {{.channel = 0,
                     .n = 2,
                     .mean = 61.6,
                     .range = 1.0,
                     .standard_deviation = 0.7,
                     .verdict = ConformanceVerdict::pass,
                     .truth = 61.25}};
  panel.verdict = ConformanceVerdict::pass;
  return panel;
}

}  // namespace gonio::test

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "emulator/quality/records.hpp"

namespace gonio::test {

/// Records with numbers and texts that are hard to keep: every double but NaN, and whatever SQL
/// might take for its own.
class RandomRecords {
 public:
  explicit RandomRecords(std::uint32_t seed) : random_(seed) {}

  RunRecord run(const std::string& batch, const std::string& fingerprint) {
    RunRecord run{.kind = flip() ? RunRecord::Kind::simulated : RunRecord::Kind::measured,
                  .batch = batch,
                  .title = text(),
                  .batch_file = text(),
                  .batch_text = text() + std::string(10000, 'x') + text(),
                  .fingerprint = fingerprint,
                  .seed = std::numeric_limits<std::uint64_t>::max() - below(2),
                  .gonio_version = "0.1.0",
                  .standard = "iso_2813/2014",
                  .sample = {text(), std::string(64, 'a')},
                  .readings = {text(), text()},
                  .lots = 1 + below(5),
                  .panels = std::uint64_t{1} << 40U,
                  .gauge_panels = below(20),
                  .started = "2026-11-22T12:00:00Z"};
    run.instruments = {{"meter_a", std::string(64, 'b')}, {text(), text()}};
    run.operators = {"Ada", "O'Hara"};
    run.channels = {{"60", "60", BatchChannel::Kind::gloss, "GU"},
                    {"60/colour", "60", BatchChannel::Kind::colour_difference, ""},
                    {"haze", "", BatchChannel::Kind::haze, text()}};
    return run;
  }

  /// Panels `first`, `first` + 1, ...: each with a reading of every channel at two positions, by
  /// two operators, in any order.
  std::vector<PanelRecord> panels(PanelRecord::Study study, std::uint64_t first, std::size_t n) {
    std::vector<PanelRecord> panels(n);
    for (std::size_t i = 0; i < n; ++i) {
      panels[i] = panel(study, first + i);
    }
    return panels;
  }

  RunOutcome outcome() {
    RunOutcome outcome{.verdict = one_of(verdicts()),
                       .finished = "2026-11-22T12:34:56Z",
                       .panels = below(1000000),
                       .readings = std::uint64_t{1} << 50U,
                       .producer_risk = maybe_number(),
                       .consumer_risk = maybe_number()};
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      outcome.channels.push_back({channel, below(1000), below(1000), number(), number(),
                                  maybe_number(), maybe_number(), maybe_number(), maybe_number()});
    }
    return outcome;
  }

 private:
  static const std::vector<ConformanceVerdict>& verdicts() {
    using enum ConformanceVerdict;
    static const std::vector all{pass, fail, inconclusive, not_applicable, skipped, error};
    return all;
  }

  PanelRecord panel(PanelRecord::Study study, std::uint64_t number_) {
    PanelRecord panel{.study = study,
                      .number = number_,
                      .lot = 1 + below(9),
                      .label = text(),
                      .verdict = one_of(verdicts())};
    for (std::uint32_t i = 0; i < 12; ++i) {
      panel.readings.push_back({.channel = i % 3,
                                .position = 1 + i / 3 % 2,
                                .repetition = 1,
                                .instrument = 0,
                                .operator_ = i / 6,
                                .value = number()});
    }
    std::shuffle(panel.readings.begin(), panel.readings.end(), random_);
    if (study == PanelRecord::Study::inspection) {
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        panel.channels.push_back({.channel = channel,
                                  .n = 4,
                                  .mean = number(),
                                  .range = number(),
                                  .standard_deviation = number(),
                                  .uniformity = static_cast<PanelVerdict>(below(4)),
                                  .verdict = one_of(verdicts()),
                                  .truth = maybe_number()});
      }
    }
    return panel;
  }

  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  bool flip() { return below(2) == 1; }
  template <class Value>
  Value one_of(const std::vector<Value>& values) {
    return values[below(values.size())];
  }
  std::optional<double> maybe_number() { return flip() ? std::optional(number()) : std::nullopt; }

  double number() {
    using Limits = std::numeric_limits<double>;
    static const std::vector<double> nasty{0.0,
                                           -0.0,
                                           0.1,
                                           1.0 / 3.0,
                                           -1e308,
                                           Limits::max(),
                                           Limits::min(),
                                           Limits::denorm_min(),
                                           -Limits::denorm_min(),
                                           4503599627370497.5,
                                           85.0,
                                           -Limits::infinity(),
                                           Limits::infinity(),
                                           9007199254740993.0,
                                           1e22};
    return flip() ? one_of(nasty) : std::normal_distribution(85.0, 3.0)(random_);
  }

  std::string text() {
    static const std::vector<std::string> nasty{"",
                                                "it's",
                                                "'; DROP TABLE run; --",
                                                "\"quoted\" \\back\\slash\\",
                                                "Prüftafel № 5 \xE2\x80\x94 光沢 \xF0\x9F\x8E\xA8",
                                                ":name $1 ? %s {} {{",
                                                "line\nbreak\ttab\r",
                                                " blanks ",
                                                "NULL",
                                                "0"};
    return one_of(nasty);
  }

  std::mt19937 random_;
};

}  // namespace gonio::test

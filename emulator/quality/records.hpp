#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/procedure/panel.hpp"
#include "emulator/standard/decision.hpp"

// What a run of a batch leaves behind, and what a store keeps. Lots, panels, positions and
// repetitions count from 1; channels, instruments and operators are places in the lists of the run.

namespace gonio {

/// What is read at a place of a panel.
struct BatchChannel {
  enum class Kind {
    gloss,              ///< in the unit of the standard's scale
    colour_difference,  ///< CIEDE2000 of the reflected light from the reference of the batch
    haze  ///< by a rule of the standard, from the panel's means: it has no readings of its own
  };
  std::string id;        ///< e.g. 60, 60/colour, or the id of a rule for haze
  std::string geometry;  ///< e.g. 60; empty for haze
  Kind kind = Kind::gloss;
  std::string unit;  ///< GU; empty for a number

  bool operator==(const BatchChannel&) const = default;
};

/// One reading.
struct ReadingRecord {
  std::uint32_t channel = 0;
  std::uint32_t position = 1;
  std::uint32_t repetition = 1;
  std::uint32_t instrument = 0;
  std::uint32_t operator_ = 0;
  double value = 0.0;  ///< as the instrument showed it

  bool operator==(const ReadingRecord&) const = default;
};

/// What the readings of one panel come to in one channel.
struct ChannelResult {
  std::uint32_t channel = 0;
  std::uint32_t n = 0;  ///< readings
  double mean = 0.0;
  double range = 0.0;
  double standard_deviation = 0.0;                   ///< of one reading; 0 of one alone
  PanelVerdict uniformity = PanelVerdict::accepted;  ///< by the reading rule of the standard
  /// Against the limits of this channel; not_applicable where it has none, or was not selected.
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  /// What an ideal instrument of the standard would read on average over the panel; nothing for a
  /// panel that was measured.
  std::optional<double> truth = {};

  bool operator==(const ChannelResult&) const = default;
};

/// One panel with all that was read on it.
struct PanelRecord {
  enum class Study {
    inspection,  ///< the sampling plan
    gauge        ///< gauge R&R: all panels by all appraisers
  };
  Study study = Study::inspection;
  std::uint64_t number = 1;  ///< of the panel in its study
  std::uint64_t lot = 1;     ///< 1 in a gauge study
  std::string label = {};    ///< as measured data call it; empty if it has no name of its own
  std::vector<ReadingRecord> readings = {};
  /// In the order of the run's; without a haze that the standard does not define for this panel.
  /// Empty in a gauge study.
  std::vector<ChannelResult> channels = {};
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;  ///< of all limits together

  bool operator==(const PanelRecord&) const = default;
};

/// As stores and reports call a study: inspection, gauge.
[[nodiscard]] const char* study_name(PanelRecord::Study study);

/// A file that a run rests on.
struct HashedFile {
  std::string name;    ///< id, or the name of the file
  std::string sha256;  ///< of its text and of the files it names, 64 hexadecimal digits

  bool operator==(const HashedFile&) const = default;
};

/// All that has to be known to compute a run again, bit for bit.
struct RunRecord {
  enum class Kind { simulated, measured };
  std::int64_t id = 0;  ///< given by the store
  Kind kind = Kind::simulated;
  std::string batch = {};  ///< id
  std::string title = {};
  std::string batch_file = {};  ///< as it was named
  std::string batch_text = {};  ///< the whole file
  /// Of the batch file, what it names, the options that change results, and the readings: equal
  /// fingerprints give equal runs.
  std::string fingerprint = {};
  std::uint64_t seed = 1;
  std::string gonio_version = {};
  std::string standard = {};  ///< id
  HashedFile sample = {};     ///< empty name: none
  HashedFile readings = {};   ///< the file of measured readings; empty name: none
  std::vector<HashedFile> instruments = {};
  std::vector<std::string> operators = {};
  std::vector<BatchChannel> channels = {};
  std::uint64_t lots = 1;
  std::uint64_t panels = 0;        ///< of the inspection, planned
  std::uint64_t gauge_panels = 0;  ///< planned
  std::string started = {};        ///< UTC, YYYY-MM-DDThh:mm:ssZ

  bool operator==(const RunRecord&) const = default;
};

/// As stores and reports call it: simulated, measured.
[[nodiscard]] const char* run_kind_name(RunRecord::Kind kind);

/// One channel of a finished run, for trends.
struct ChannelTrend {
  std::uint32_t channel = 0;
  std::uint64_t panels = 0, readings = 0;
  double mean = 0.0;                          ///< of panel means
  double standard_deviation = 0.0;            ///< of panel means
  std::optional<double> low = {}, high = {};  ///< limits
  std::optional<double> cpk = {}, ppk = {};

  bool operator==(const ChannelTrend&) const = default;
};

/// What a finished run came to.
struct RunOutcome {
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  std::string finished = {};  ///< UTC, YYYY-MM-DDThh:mm:ssZ
  std::uint64_t panels = 0, readings = 0;
  std::optional<double> producer_risk = {}, consumer_risk = {};
  std::vector<ChannelTrend> channels = {};

  bool operator==(const RunOutcome&) const = default;
};

/// A run as a store lists it.
struct StoredRun {
  RunRecord record;
  std::optional<RunOutcome> outcome = {};  ///< nothing while it is not finished
};

}  // namespace gonio

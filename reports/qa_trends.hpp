#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/records.hpp"
#include "emulator/statistics/control_chart.hpp"
#include "reports/report_table.hpp"

// What the runs of a store show together.

namespace gonio {

/// One channel over the finished runs of one batch, or of all batches with the same limits.
struct Trend {
  struct Point {
    const StoredRun* run;
    const ChannelTrend* found;
  };
  std::string batch = {};  ///< id; empty: of several batches
  std::string standard = {};
  BatchChannel channel = {};
  Interval limits = {};  ///< of the latest run
  std::vector<Point> points = {};
  std::optional<ControlCharts::Result> charts = {};  ///< I and MR of the means; of two runs or more
};

/// By batch, then by channel, in the order in which they first come; then those of several batches.
/// @param runs  has to outlive what is returned.
[[nodiscard]] std::vector<Trend> trends(const std::vector<StoredRun>& runs);

/// e.g. "Gloss at 60 of batch coil_coating".
[[nodiscard]] std::string trend_words(const Trend& trend);
/// e.g. "5 runs of 2 batches: 3 pass, 1 fail, 1 not finished".
[[nodiscard]] std::string run_counts(const std::vector<StoredRun>& runs);
/// YYYY-MM-DD hh:mm of a time of a run; as it is if it is no such time.
[[nodiscard]] std::string time_text(const std::string& time);

[[nodiscard]] ReportTable run_table(const std::vector<StoredRun>& runs);
[[nodiscard]] ReportTable trend_table(const Trend& trend);

}  // namespace gonio

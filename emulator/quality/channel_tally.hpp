#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/records.hpp"
#include "emulator/statistics/running_statistics.hpp"

namespace gonio {

/// The spread of values as it shows between neighbours: their mean moving range over d2 of two.
///
///   s = MR / d2,   d2 = 2 / sqrt(pi)
///
/// The degrees of freedom are those of a standard deviation that is known as well as this one:
/// nu = 1 / (2 Var(s) / sigma^2), with the covariance of neighbouring ranges, for normal values.
class MovingSpread {
 public:
  void add(double value);
  [[nodiscard]] EstimatedSpread result() const;  ///< all 0 of fewer than two values

 private:
  double last_ = 0.0;
  std::uint64_t values_ = 0;
  RunningStatistics ranges_;
};

/// What is kept of one channel while panels come: no panel, so that memory does not grow.
class ChannelTally {
 public:
  /// @param baseline  of the control charts; fewer than two count as two.
  explicit ChannelTally(std::uint64_t baseline);

  void add(std::uint64_t lot, const ChannelResult& panel);
  void add(const ReadingRecord& reading);
  /// What follows from the panels; of the positions, numbers and statistics alone.
  /// @param limits  nothing on both sides: none.
  [[nodiscard]] ChannelSummary result(const Interval& limits) const;

 private:
  [[nodiscard]] std::optional<Capability> capability_within(const Interval& limits) const;

  RunningStatistics means_, ranges_;
  MovingSpread neighbours_;
  NestedVariance nested_;
  ControlCharts charts_;
  Histogram histogram_;
  ChannelSummary counted_ = {};  // what is only counted
  std::map<std::uint32_t, RunningStatistics> positions_;
};

}  // namespace gonio

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/reading_uncertainty.hpp"
#include "emulator/quality/records.hpp"
#include "emulator/standard/reading_rule.hpp"
#include "emulator/statistics/running_statistics.hpp"

namespace gonio {

/// Judges panels by the reading rule of the standard and by the limits of a batch.
class PanelJudge {
 public:
  /// Both must outlive this object.
  PanelJudge(const Batch& batch, const ReadingUncertainties& uncertainties);

  /// Fills `channels` (but for their truth) and `verdict` from the readings. A panel that the
  /// reading rule rejects fails; one that has too few readings for it does not pass.
  /// @return  readings that the rule still asks for, the most of any channel.
  /// @throws std::invalid_argument  for a panel without a reading of a channel.
  std::size_t judge(PanelRecord& panel) const;

  /// Largest U of a mean in a channel over all instruments, 0 if there is none.
  [[nodiscard]] double expanded_uncertainty(std::uint32_t channel) const;

 private:
  [[nodiscard]] double expanded_uncertainty(const PanelRecord& panel, std::uint32_t channel) const;
  void decide_limits(PanelRecord& panel) const;

  const Batch& batch_;
  const ReadingUncertainties& uncertainties_;
  ReadingRule of_gloss_ = {}, of_colour_ = {};
};

/// The geometry that the standard selects for gloss values by channel, if the batch asks for it;
/// nothing if all have to keep their limits.
/// @param mean  by channel; what is not finite is not there.
[[nodiscard]] std::optional<std::string> selected_geometry(const Batch& batch,
                                                           const std::vector<double>& mean);
/// The haze that a channel stands for, from gloss by channel; NaN where the standard does not
/// define it.
[[nodiscard]] double haze_of(const Batch& batch, std::uint32_t channel,
                             const std::vector<double>& mean);
/// Whether the limits of a requirement count, if that geometry was selected.
[[nodiscard]] bool counts(const Batch& batch, const Requirement& requirement,
                          const std::optional<std::string>& selected);

/// Judges a lot by its panels, which come one after another.
class LotJudge {
 public:
  LotJudge(const Batch& batch, const PanelJudge& judge);

  void add(const PanelRecord& panel);  ///< judged
  /// Of the panels since the last call; the next ones are of another lot.
  [[nodiscard]] LotSummary result();

 private:
  [[nodiscard]] ConformanceVerdict by_attributes() const;
  [[nodiscard]] ConformanceVerdict by_means() const;

  const Batch& batch_;
  const PanelJudge& judge_;
  LotSummary lot_ = {};
  std::vector<RunningStatistics> means_ = {};  // of panel means, by channel
};

/// When a lot is accepted, and how decisions are made, in words.
[[nodiscard]] std::string acceptance_words(const Batch& batch);
[[nodiscard]] std::string decision_words(const Batch& batch);

}  // namespace gonio

#pragma once

#include <cstdint>
#include <vector>

#include "emulator/quality/channel_tally.hpp"
#include "emulator/quality/gauge_tally.hpp"
#include "emulator/quality/panel_judgement.hpp"
#include "emulator/quality/qa_result.hpp"

namespace gonio {

/// Takes the judged panels of a run in the order of their numbers, and keeps what is told of them,
/// in memory that does not grow.
class BatchSummary {
 public:
  /// All must outlive this object.
  BatchSummary(const Batch& batch, const PanelJudge& judge);

  void add(const PanelRecord& panel);  ///< of either study
  /// Verdict, counts, lots, channels and gauge study: all of QaResult but the run, the store, the
  /// risks, the curves and the answers. Counts and channels are those of the inspection.
  ///
  /// The subgroups of capability are panels, its values their means: `within` is their spread from
  /// one panel to the next (the mean moving range, as on the I chart), `overall` their standard
  /// deviation. The batch passes if the share of accepted lots reaches plan.accepted_lots, and
  /// fails if the refused ones leave that impossible; inconclusive lots are neither.
  [[nodiscard]] QaResult result() const;

 private:
  void close_lot(LotJudge& open, QaResult& counted) const;
  [[nodiscard]] ChannelSummary channel_summary(std::uint32_t channel) const;

  const Batch& batch_;
  const PanelJudge& judge_;
  LotJudge open_lot_;
  std::uint64_t open_number_ = 0;  // of the lot of the last panel
  QaResult counted_;
  std::vector<ChannelTally> channels_;
  GaugeTally gauge_;
};

/// Verdict of a batch of lots that do or do not conform; not_applicable if none was judged.
/// @param share  of the judged lots that has to be accepted, in (0, 1].
[[nodiscard]] ConformanceVerdict batch_verdict(std::uint64_t accepted, std::uint64_t refused,
                                               std::uint64_t inconclusive, double share);

}  // namespace gonio

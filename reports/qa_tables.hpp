#pragma once

#include <vector>

#include "emulator/quality/qa_result.hpp"
#include "reports/report_table.hpp"

// The tables of a QA result, the same on a terminal and on a page.

namespace gonio {

[[nodiscard]] ReportTable channel_table(const QaResult& result);
[[nodiscard]] ReportTable capability_table(const QaResult& result);
[[nodiscard]] ReportTable spread_table(const QaResult& result);
[[nodiscard]] ReportTable control_table(const QaResult& result);
/// @param most  rows.
[[nodiscard]] ReportTable lot_table(const QaResult& result, std::size_t most);
[[nodiscard]] ReportTable gauge_table(const QaResult& result, const ChannelGauge& gauge);
[[nodiscard]] ReportTable anova_table(const QaResult& result, const ChannelGauge& gauge);
[[nodiscard]] ReportTable risk_table(const Risks& risks);
/// At most so many points, evenly taken.
[[nodiscard]] ReportTable curve_table(const QaResult& result, const OcCurve& curve,
                                      std::size_t most);
[[nodiscard]] ReportTable answer_table(const ReadingsAnswer& answer);
[[nodiscard]] ReportTable answer_table(const SpreadAnswer& answer);
[[nodiscard]] ReportTable position_table(const ChannelSummary& channel);
/// What the run rests on, each with its hash.
[[nodiscard]] ReportTable file_table(const RunRecord& run);

}  // namespace gonio

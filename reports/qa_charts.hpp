#pragma once

#include "emulator/quality/qa_result.hpp"
#include "reports/page.hpp"

// The charts of QA: each with its caption and the names of its curves.

namespace gonio {

/// Those of X-bar and R, then of I and MR; of what there is.
[[nodiscard]] PageList control_figures(Figures& figures, const ChannelSummary& channel);
/// Means of panels, with limits and U about them.
[[nodiscard]] PageData histogram_figure(Figures& figures, const ChannelSummary& channel);
/// Whether it is known where any of its readings is taken.
[[nodiscard]] bool has_places(const ChannelSummary& channel);
/// The spots on the panel with what they read more or less than all together.
[[nodiscard]] PageData panel_figure(Figures& figures, const QaResult& result,
                                    const ChannelSummary& channel);
[[nodiscard]] PageData gauge_figure(Figures& figures, const QaResult& result,
                                    const ChannelGauge& gauge);
[[nodiscard]] PageData curve_figure(Figures& figures, const QaResult& result, const OcCurve& curve);
[[nodiscard]] PageData answer_figure(Figures& figures, const ReadingsAnswer& answer);
[[nodiscard]] PageData answer_figure(Figures& figures, const SpreadAnswer& answer);

}  // namespace gonio

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/qa_result.hpp"
#include "reports/conformance_words.hpp"
#include "reports/limit_words.hpp"
#include "reports/measurement_words.hpp"
#include "reports/share_words.hpp"
#include "reports/uncertain_words.hpp"

// How QA of a batch is put into words, the same in every format. Nothing is escaped here.

namespace gonio {

/// e.g. "gloss at 60", "haze haze_20".
[[nodiscard]] std::string channel_words(const BatchChannel& channel);
/// e.g. ", in GU"; empty for a number.
[[nodiscard]] std::string in_unit(const BatchChannel& channel);
/// e.g. "85 +- 3 GU", "at least 80 GU", "none".
[[nodiscard]] std::string limits_words(const Interval& limits, const std::optional<double>& target,
                                       const std::string& unit);
[[nodiscard]] std::string limits_words(const ChannelSummary& channel);
/// Of the reading rule of the standard, in the order of PanelVerdict.
[[nodiscard]] std::string uniformity_words(std::size_t panel_verdict);
/// e.g. "2 of 3 beyond 2 sigma on one side". @param rule  1 to 4.
[[nodiscard]] std::string rule_words(int rule);
/// Of a product, e.g. "refractive index", "mean".
/// What the closed form of a curve is: exact for measured readings, which count as normal; of a
/// product the normal model of the same moments.
[[nodiscard]] std::string closed_form_words(const OcCurve& curve);
[[nodiscard]] std::string parameter_words(const std::string& parameter);
/// Its deviation or spread: in % where it is a logarithm of a ratio.
[[nodiscard]] std::string parameter_text(const std::string& parameter, double value);
/// By which it is multiplied when it is shown: 100 where it is shown in %.
[[nodiscard]] double parameter_scale(const std::string& parameter);

/// What the verdict means, in a sentence.
[[nodiscard]] std::string qa_meaning(const QaResult& result);
/// e.g. "120 panels: 118 pass, 1 fails, 1 inconclusive".
[[nodiscard]] std::string panel_counts(const QaResult& result);
[[nodiscard]] std::string lot_counts(const QaResult& result);
/// e.g. "3 lots of 40 panels, 3 readings of a panel and channel".
[[nodiscard]] std::string extent_words(const QaResult& result);
/// The rules in a line, for below a table.
[[nodiscard]] std::string rules_words();
/// e.g. "in control", "not in control: rule 1 twice, first at panel 17". @param point  what one
/// is.
[[nodiscard]] std::string control_words(const ControlChart& chart, const std::string& point);
/// A chart with its name: X-bar, R, I or MR.
struct NamedChart {
  const char* name;
  const ControlChart* chart;
};
/// Those that there are; they belong to `charts`.
[[nodiscard]] std::vector<NamedChart> named_charts(const ControlCharts::Result& charts);

/// Panels that the reading rule of the standard does not let pass.
[[nodiscard]] std::uint64_t rejected_by_rule(const ChannelSummary& channel);
/// Of that number, or one that only has it: reports show what they are given.
[[nodiscard]] BatchChannel channel_at(const QaResult& result, std::uint32_t channel);
/// Of all readings, over the positions of a panel; 0 if there are none.
[[nodiscard]] double mean_of_positions(const ChannelSummary& channel);

/// A line of a gauge study.
struct GaugeComponent {
  const char* name;
  double sd;
  double percent_of_study;                     ///< of sd_total
  std::optional<double> percent_of_tolerance;  ///< of 6 sd
};
/// R&R, repeatability, reproducibility, appraisers, interaction, panels, all of them.
[[nodiscard]] std::vector<GaugeComponent> gauge_components(const GaugeStudy& study);
/// e.g. "12.3 %"; "-" for nothing.
[[nodiscard]] std::string percent_text(const std::optional<double>& percent);
/// What the gauge is good for by the usual bounds of 10 % and 30 %.
[[nodiscard]] std::string gauge_words(const GaugeStudy& study);
/// How the risks were found.
[[nodiscard]] std::string risk_words(const Risks& risks);
/// The answers, a sentence each.
[[nodiscard]] std::string answer_words(const ReadingsAnswer& answer);
[[nodiscard]] std::string answer_words(const SpreadAnswer& answer);
[[nodiscard]] std::vector<std::string> answers(const QaResult& result);

}  // namespace gonio

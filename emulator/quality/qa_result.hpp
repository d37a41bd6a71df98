#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/interval.hpp"
#include "emulator/quality/records.hpp"
#include "emulator/statistics/capability.hpp"
#include "emulator/statistics/control_chart.hpp"
#include "emulator/statistics/gauge_study.hpp"
#include "emulator/statistics/histogram.hpp"
#include "emulator/statistics/nested_variance.hpp"
#include "emulator/statistics/sampling_plan.hpp"

// All that is told of a run.

namespace gonio {

/// Readings at one position of all panels.
struct PositionSummary {
  std::uint32_t position = 1;
  std::optional<double> x_mm = {}, y_mm = {};  ///< nothing where only its number is known
  /// Of the measuring spot, half axes; 0: a point, nothing: not known.
  std::optional<double> half_length_mm = {}, half_width_mm = {};
  std::uint64_t readings = 0;
  double mean = 0.0, standard_deviation = 0.0;
};

/// One channel over all panels of the inspection.
struct ChannelSummary {
  BatchChannel channel;
  Interval limits = {};
  std::optional<double> target = {};
  /// Largest U of a panel's mean, k = 2, in the unit of the channel; what the decisions rest on.
  double expanded_uncertainty = 0.0;
  std::uint64_t panels = 0, readings = 0;
  double mean = 0.0, standard_deviation = 0.0;  ///< of panel means
  double lowest = 0.0, highest = 0.0;           ///< panel means
  double mean_range = 0.0;                      ///< of the readings of a panel
  NestedSpread spread = {};
  std::optional<Capability> capability = {};  ///< of panel means; with limits and two panels
  ControlCharts::Result charts = {};
  Histogram::Bins histogram = {};                          ///< of panel means
  std::array<std::uint64_t, 4> uniformity = {};            ///< panels, in the order of PanelVerdict
  std::uint64_t passed = 0, failed = 0, inconclusive = 0;  ///< panels
  std::vector<PositionSummary> positions = {};
};

struct LotSummary {
  std::uint64_t number = 1;
  std::uint64_t panels = 0, nonconforming = 0, inconclusive = 0;
  std::uint64_t not_uniform = 0;  ///< panels that the reading rule rejects; they do not conform
  std::vector<double> mean = {};  ///< of panel means, by channel
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
};

struct ChannelGauge {
  std::uint32_t channel = 0;
  std::vector<std::string> appraisers = {};  ///< "instrument, operator"
  std::uint64_t panels = 0;
  std::uint32_t repetitions = 0;
  GaugeStudy study = {};
};

/// How often decisions would be wrong. Producer's: conforms and is not accepted; consumer's: does
/// not conform and is accepted; of all that is inspected. Inconclusive is not accepted.
struct RiskSummary {
  /// Share that conforms, and that is accepted.
  Estimate conforming = {}, accepted = {};
  Estimate producer = {}, consumer = {};
};

struct Risks {
  bool from_normal_model = false;      ///< of measured readings; else by simulated lots
  std::uint64_t lots = 0, panels = 0;  ///< simulated
  RiskSummary lot = {}, panel = {};
  /// Of a panel in the channel with the narrowest limits, for normal distributions of the same
  /// moments: JCGM 106, 9.5.
  std::optional<GlobalRisks> panel_normal = {};
};

struct OcPoint {
  double offset = 0.0;               ///< of the parameter
  double mean = 0.0;                 ///< true one of the channel, in its unit
  double beyond = 0.0;               ///< share of panels truly beyond the limits
  Estimate accepted = {};            ///< share of lots, by simulation
  std::optional<double> exact = {};  ///< closed form
};

/// The operating characteristic: what share of lots is accepted, over the mean of the lots.
struct OcCurve {
  std::uint32_t channel = 0;
  std::string parameter = {};    ///< that moves the mean: of sample_parameter_names, or mean
  std::string closed_form = {};  ///< binomial, normal, noncentral t; empty if there is none
  std::uint64_t lots = 0;        ///< simulated for each point
  double present_mean = 0.0;     ///< of the product as it is
  std::vector<OcPoint> points = {};
};

/// How many readings of a panel keep both risks of a lot below a limit.
struct ReadingsAnswer {
  struct Row {
    std::uint64_t readings = 0;  ///< of each panel in each channel
    Estimate producer = {}, consumer = {};
  };
  double risk = 0.05;
  std::uint64_t present = 0;
  std::optional<std::uint64_t> needed = {};  ///< nothing: none of the rows is enough
  std::vector<Row> rows = {};
};

/// How much a parameter may vary so that not more than a share of the lots is refused.
struct SpreadAnswer {
  struct Row {
    double spread = 0.0;    ///< standard deviation of the parameter, all levels together
    Estimate refused = {};  ///< share of lots
    double beyond = 0.0;    ///< share of panels truly beyond the limits
  };
  std::string parameter = {};  ///< of sample_parameter_names
  double risk = 0.05;
  double present = 0.0;                ///< standard deviation now
  std::optional<double> allowed = {};  ///< nothing: even none would be too much
  bool unlimited = false;              ///< no spread that was tried is too much
  std::vector<Row> rows = {};          ///< by spread
};

/// How a run is told of.
struct QaResult {
  RunRecord run;
  std::string store = {};  ///< url
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  std::string decision = {};    ///< in words
  std::string acceptance = {};  ///< of a lot, in words
  std::uint64_t panels = 0, readings = 0;
  std::uint64_t panels_passed = 0, panels_failed = 0, panels_inconclusive = 0;
  std::uint64_t lots_accepted = 0, lots_refused = 0, lots_inconclusive = 0;
  std::vector<LotSummary> lots = {};  ///< the first 100
  std::vector<ChannelSummary> channels = {};
  /// Of `channels`: the one that JSON's mean_gu and the like speak of: with the lowest Cpk, or the
  /// first.
  std::size_t main_channel = 0;
  double panel_length_mm = 0.0, panel_width_mm = 0.0;  ///< 0: not known
  std::vector<ChannelGauge> gauge = {};
  std::optional<Risks> risks = {};
  std::vector<OcCurve> oc_curves = {};
  std::optional<ReadingsAnswer> readings_answer = {};
  std::vector<SpreadAnswer> spread_answers = {};
  double surrogate_error = 0.0;  ///< largest one seen of the polynomials that stand for the optics
  std::vector<std::string> remarks = {};  ///< what a reader has to know, whole sentences

  /// What a store keeps of it.
  [[nodiscard]] RunOutcome outcome(const std::string& finished) const;
};

}  // namespace gonio

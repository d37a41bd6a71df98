#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "emulator/quality/panel_source.hpp"
#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/reading_uncertainty.hpp"

namespace gonio {

/// How plans are tried: by lots of the batch's own seed whose numbers lie far beyond those of any
/// run. All that is tried for one answer sees the same draws, so that differences are those of what
/// was changed. All is the same for any number of threads.
struct RiskOptions {
  std::uint64_t lots = 4000;            ///< simulated to tell the risks
  std::uint64_t lots_per_point = 1000;  ///< of a curve or a table
  double risk = 0.05;                   ///< of the answers
  /// Called with what is done, of what is to do, and of which work; one at a time.
  std::function<void(const char* work, std::size_t done, std::size_t total)> advance = {};
};

/// A lot conforms if in each channel with limits its true mean keeps them (acceptance by the mean),
/// or at most plan.acceptable_share of its panels are truly beyond them (other plans); a panel, if
/// its truth keeps them. With `selected_only` the geometry counts that the true values select.
/// `panel_normal` is of the channel whose limit is the fewest standard deviations of true values
/// away: with their mean and standard deviation, u = the root mean square of what panel means are
/// off, and the limits drawn in by the guard band.
[[nodiscard]] Risks risks(const Batch& batch, const ReadingUncertainties& uncertainties,
                          const PanelSourceFactory& source, const RiskOptions& options);

/// Share of lots that is accepted while the mean moves from where nearly none conforms to where
/// nearly all do, on both sides of two limits.
/// @param shifted  the batch whose product is `offset` away from what it is, in the parameter.
/// @param low, high  range of the offset.
struct OcRequest {
  std::uint32_t channel = 0;
  std::string parameter = {};
  double low = 0.0, high = 0.0;
  std::size_t points = 21;
  std::function<std::unique_ptr<PanelSource>(double offset)> shifted = {};
};
/// Points lie close where acceptance changes: half of them evenly, one at the product as it is,
/// each further one in the middle of the step in which acceptance changes or bends most.
///
/// With the closed form where there is one, as AcceptanceProbability states. It is exact for a
/// source that has normal components. For any other it is that of the normal product and the
/// instruments that have the moments of the simulated lots of that point: to compare with. Where
/// displays show steps that matter, panels at a limit are accepted more often than it says.
/// @throws std::invalid_argument  for an empty range.
[[nodiscard]] OcCurve operating_characteristic(const Batch& batch,
                                               const ReadingUncertainties& uncertainties,
                                               const OcRequest& request,
                                               const RiskOptions& options);

/// Tries 1, 2, 3, 4, 6, 8, 12, 16, 24 readings of each panel, as far as the reading rule allows so
/// few: up to the number of positions one at each of so many, spread evenly over their list; beyond
/// it more repetitions at all, so that the number is rounded up to a multiple. `needed` is the
/// first number with which both estimates of a lot's risks keep the limit; rows go on to the
/// present number, and are four at least. Further positions stay as they are.
[[nodiscard]] ReadingsAnswer readings_for_risk(const Batch& batch,
                                               const ReadingUncertainties& uncertainties,
                                               const PanelSourceFactory& source,
                                               const RiskOptions& options);

/// Spreads are tried up to so many times the present one.
constexpr double largest_spread_factor = 4.0;

/// Tries spreads of one parameter, all its levels together, the others as they are: none, the
/// present one, and from there twice as much or halfway, until what is allowed is known to 2 %.
/// Refused is what is not accepted, inconclusive lots with it.
/// @param parameter  of sample_parameter_names.
/// @throws std::invalid_argument  unless the batch has a product that varies in it.
[[nodiscard]] SpreadAnswer spread_for_risk(const Batch& batch, std::size_t parameter,
                                           const ReadingUncertainties& uncertainties,
                                           const PanelSourceFactory& source,
                                           const RiskOptions& options);

}  // namespace gonio

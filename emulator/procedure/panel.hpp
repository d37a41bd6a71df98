#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "emulator/standard/reading_rule.hpp"

namespace gonio {

/// What the readings of one specimen come to.
enum class PanelVerdict { accepted, more_readings, not_uniform, rejected };
/// As input files and people call them, in the order of PanelVerdict.
inline constexpr std::array<const char*, 4> panel_verdict_names{"accepted", "more_readings",
                                                                "not_uniform", "rejected"};
[[nodiscard]] const char* panel_verdict_name(PanelVerdict verdict);

struct PanelResult {
  std::size_t n = 0;
  double mean_gu = 0.0;
  double range_gu = 0.0;               ///< between the extremes
  double standard_deviation_gu = 0.0;  ///< of a sample: over n - 1; 0 of one reading
  /// Of a reading from the mean, as a share of the mean; nothing where the mean is not positive.
  std::optional<double> largest_relative_deviation = {};
  PanelVerdict verdict = PanelVerdict::accepted;
  std::size_t further = 0;  ///< readings that are still to be taken, at least
  /// Of the rule that the verdict rests on; `accepted` rests on the weakest of all that were asked.
  Evidence evidence = {};
};

/// Judges the readings of one specimen in one geometry. Too few readings are not judged; then the
/// graver finding comes first: rejected, not uniform, more readings. A share of a mean that is not
/// positive has no meaning and is not asked for.
/// @param readings_gu  in any order.
/// @throws std::invalid_argument  if there are none, or one is not finite.
[[nodiscard]] PanelResult judge_panel(const std::vector<double>& readings_gu,
                                      const ReadingRule& rule);

}  // namespace gonio

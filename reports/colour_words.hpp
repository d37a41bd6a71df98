#pragma once

#include <string>
#include <vector>

#include "reports/colour_report.hpp"
#include "reports/report_table.hpp"

// Colours in words, the same for a terminal and for a page.

namespace gonio {

/// e.g. "illuminant D65, 10 deg observer".
[[nodiscard]] std::string conditions_words(const ColourConditions& conditions);
[[nodiscard]] ReportTable colour_table(const std::vector<ColourMeasurement>& measurements);
/// Flop indices, and what rests on memory alone.
[[nodiscard]] std::vector<std::string> colour_notes(
    const ColourHeader& header, const std::vector<ColourMeasurement>& measurements);

}  // namespace gonio

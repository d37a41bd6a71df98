#pragma once

#include <string>
#include <vector>

#include "reports/measurement_report.hpp"

// How measurements are put into words, the same for a terminal and for a page.

namespace gonio {

/// A number with so many decimals; a zero has no sign.
[[nodiscard]] std::string fixed_text(double value, int decimals);
/// An angle in degrees without the last bits that its way through radians leaves: 60, not
/// 59.99999999999999.
[[nodiscard]] double degrees_for_output(Angle angle);
/// The value as the standard has it reported, e.g. to the nearest unit.
[[nodiscard]] std::string reported_text(double gloss, const Standard& standard);
/// What a reader must know of single samples: selected geometries that were not measured, what
/// spots covered of a panel, haze.
[[nodiscard]] std::vector<std::string> sample_notes(const MeasurementHeader& header,
                                                    const std::vector<Measurement>& measurements);
/// Which geometries rest on numbers from memory; empty if none does.
[[nodiscard]] std::string informative_note(const std::vector<Measurement>& measurements);

}  // namespace gonio

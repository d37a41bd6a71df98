#pragma once

#include <string>

#include "reports/conformance_report.hpp"

// How numbers, limits and what was observed are put into words. Nothing is escaped here.

namespace gonio {

/// e.g. "theta_i at 60".
[[nodiscard]] std::string limit_name(const LimitRow& limit);
/// e.g. "60 +- 0.1 deg", "at most 0.5 GU", "not known".
[[nodiscard]] std::string limit_text(const LimitRow& limit);

/// What was judged, e.g. "gloss at 60, black_glass".
[[nodiscard]] std::string observation_name(const Observation& observation);
/// e.g. "60.04 +- 0.02 deg".
[[nodiscard]] std::string found_text(const Observation& observation);
/// e.g. "limit 60 +- 0.1 deg".
[[nodiscard]] std::string limit_text(const Observation& observation);
/// All of it, e.g. "theta_i at 60: 60.04 +- 0.02 deg, limit 60 +- 0.1 deg".
[[nodiscard]] std::string observation_text(const Observation& observation);

/// A number to six digits, or in words what is none; a zero has no sign.
[[nodiscard]] std::string number_text(double value);
/// A number with its unit, if it has one.
[[nodiscard]] std::string number_text(double value, const std::string& unit);
/// "file:line"; empty if there is no file.
[[nodiscard]] std::string place_text(const SourceMark& mark);

}  // namespace gonio

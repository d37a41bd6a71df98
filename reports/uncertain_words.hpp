#pragma once

#include <optional>
#include <string>

#include "emulator/uncertainty/distribution.hpp"

// How numbers that are uncertain are put into words. Nothing is escaped here.

namespace gonio {

/// e.g. "98 %", "not stated".
[[nodiscard]] std::string probability_text(const std::optional<double>& probability);

/// An uncertainty to two digits; "-" for what is no number.
[[nodiscard]] std::string uncertainty_text(double u);
/// A value to the decimals of the two digits of its uncertainty, at most 6. A zero has no sign.
[[nodiscard]] std::string measured_text(double value, double u);
/// The same with its sign, e.g. "+0.12".
[[nodiscard]] std::string signed_text(double value, int decimals);
[[nodiscard]] int decimals_of(double u);
/// e.g. "normal", "Student, 12 degrees of freedom", "rectangular".
[[nodiscard]] std::string distribution_text(const Distribution& distribution);

}  // namespace gonio

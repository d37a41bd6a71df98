#include "reports/uncertain_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/limit_words.hpp"
#include "reports/measurement_words.hpp"

namespace gonio {

std::string probability_text(const std::optional<double>& probability) {
  if (!probability || !std::isfinite(*probability)) {
    return "-";
  }
  constexpr double nearly = 0.9995;  // which "100.0 %" would round to
  return *probability >= nearly         ? "> 99.9 %"
         : *probability <= 1.0 - nearly ? "< 0.1 %"
                                        : fmt::format("{:.1f} %", 100.0 * *probability);
}

int decimals_of(double u) {
  constexpr int most = 6;
  constexpr int usual = 3;
  if (!std::isfinite(u) || u <= 0.0) {
    return usual;
  }
  return int(std::clamp(1.0 - std::floor(std::log10(u)), 0.0, double(most)));
}

std::string uncertainty_text(double u) {
  if (!std::isfinite(u)) {
    return "-";
  }
  constexpr double tiny = 1e-4;  // better by its power of ten
  return u != 0.0 && std::abs(u) < tiny ? fmt::format("{:.1e}", u)
                                        : fixed_text(u, decimals_of(std::abs(u)));
}

std::string measured_text(double value, double u) {
  return std::isfinite(value) ? fixed_text(value, decimals_of(u)) : "-";
}

std::string signed_text(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "-";
  }
  const std::string text = fixed_text(value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return value > 0.0 && !is_zero ? "+" + text : text;
}

std::string distribution_text(const Distribution& distribution) {
  using enum Distribution::Shape;
  const bool has_few = std::isfinite(distribution.degrees_of_freedom);
  const std::string freedom =
      has_few ? fmt::format(", {} degrees of freedom", number_text(distribution.degrees_of_freedom))
              : "";
  switch (distribution.shape) {
    case normal:
      return has_few ? "Student" + freedom : "normal";
    case student:
      return "Student" + freedom;
    case rectangular:
      return "rectangular" + freedom;
    case triangular:
      return "triangular" + freedom;
    case arcsine:
      break;
  }
  return "arcsine" + freedom;
}

}  // namespace gonio

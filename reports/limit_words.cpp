#include "reports/limit_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "emulator/core/quantity.hpp"

namespace gonio {

namespace {

constexpr int most_digits = 17;  // of a double

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

std::string digits_text(double value, int digits) {
  return fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, digits);
}

/// Whether value and limit compare in words as they do in numbers.
bool tells_apart(const std::string& value_text, double value, double limit) {
  const double shown = parse_quantity(value_text, Dimension::number).value_or(value);
  const double shown_limit = parse_quantity(number_text(limit), Dimension::number).value_or(limit);
  return (value < limit) == (shown < shown_limit) && (value > limit) == (shown > shown_limit);
}

/// With as many digits as it takes to see on which side of its limits it lies.
std::string judged_text(const Observation& observation) {
  const double value = *observation.value;
  std::string text = number_text(value);
  for (int digits = 7; std::isfinite(value) && digits <= most_digits; ++digits) {
    const auto shows = [&](const std::optional<double>& limit) {
      return !limit || !std::isfinite(*limit) || tells_apart(text, value, *limit);
    };
    if (shows(observation.low) && shows(observation.high)) {
      break;
    }
    text = digits_text(value, digits);
  }
  return text;
}

/// Limits in words, without what they are called; empty if there are none.
std::string interval_text(const std::optional<double>& nominal, const std::optional<double>& low,
                          const std::optional<double>& high, const std::string& unit) {
  if (!low || !high) {
    return low    ? "at least " + number_text(*low, unit)
           : high ? "at most " + number_text(*high, unit)
                  : "";
  }
  const double half = (*high - *low) / 2.0;
  constexpr double same = 1e-9;  // relative: the limits were computed from nominal and tolerance
  const bool is_centred =
      nominal && std::abs(*nominal - *low - half) <= same * (std::abs(*nominal) + half);
  return is_centred
             ? with_unit(fmt::format("{} +- {}", number_text(*nominal), number_text(half)), unit)
             : fmt::format("{} to {}", number_text(*low), number_text(*high, unit));
}

}  // namespace

std::string limit_name(const LimitRow& limit) {
  return limit.geometry.empty() ? limit.quantity
                                : fmt::format("{} at {}", limit.quantity, limit.geometry);
}

std::string limit_text(const LimitRow& limit) {
  std::optional<double> low = limit.low;
  std::optional<double> high = limit.high;
  if (limit.nominal && limit.tolerance) {
    low = low.value_or(*limit.nominal - *limit.tolerance);
    high = high.value_or(*limit.nominal + *limit.tolerance);
  }
  const std::string interval = interval_text(limit.nominal, low, high, limit.unit);
  return !interval.empty() ? interval
         : limit.nominal   ? number_text(*limit.nominal, limit.unit) + ", tolerance not known"
                           : "not known";
}

std::string observation_name(const Observation& observation) {
  std::string text = observation.quantity;
  if (!observation.geometry.empty()) {
    text += " at " + observation.geometry;
  }
  if (!observation.subject.empty()) {
    text += ", " + observation.subject;
  }
  return text;
}

std::string found_text(const Observation& observation) {
  if (!observation.value) {
    return observation.found.empty() ? "nothing" : observation.found;
  }
  std::string text = judged_text(observation);
  if (observation.expanded_uncertainty != 0.0) {
    text += " +- " + number_text(observation.expanded_uncertainty);
  }
  text = std::isfinite(*observation.value) ? with_unit(text, observation.unit) : text;
  return observation.found.empty() ? text : fmt::format("{} ({})", text, observation.found);
}

std::string limit_text(const Observation& observation) {
  if (!observation.expected_text.empty()) {
    return "expected " + observation.expected_text;
  }
  const std::string interval =
      interval_text(observation.expected, observation.low, observation.high, observation.unit);
  return !interval.empty()      ? "limit " + interval
         : observation.expected ? "expected " + number_text(*observation.expected, observation.unit)
                                : "no limit";
}

std::string observation_text(const Observation& observation) {
  std::string text = fmt::format("{}: {}, {}", observation_name(observation),
                                 found_text(observation), limit_text(observation));
  if (!observation.origin.empty()) {
    text += fmt::format(" ({})", observation.origin);
  }
  return observation.note.empty() ? text : fmt::format("{}; {}", text, observation.note);
}

std::string number_text(double value) {
  constexpr int digits = 6;
  return std::isnan(value)   ? "not a number"
         : std::isinf(value) ? (value > 0.0 ? "infinite" : "minus infinite")
                             : digits_text(value, digits);
}

std::string number_text(double value, const std::string& unit) {
  return std::isfinite(value) ? with_unit(number_text(value), unit) : number_text(value);
}

std::string place_text(const SourceMark& mark) {
  return mark.line > 0 ? fmt::format("{}:{}", mark.file, mark.line) : mark.file;
}

}  // namespace gonio

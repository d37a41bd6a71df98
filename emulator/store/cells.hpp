#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace gonio {

/// A count or a place as a cell. @throws std::invalid_argument  if BIGINT does not hold it.
template <std::unsigned_integral Number>
long long cell(Number number) {
  if (!std::in_range<long long>(number)) {
    throw std::invalid_argument(
        fmt::format("store: expected a number below 2^63, found {}", number));
  }
  return static_cast<long long>(number);
}

/// @throws std::invalid_argument  for NaN, which SQLite does not tell from NULL.
inline double cell(double number) {
  if (std::isnan(number)) {
    throw std::invalid_argument("store: expected a number, found NaN");
  }
  return number;
}

inline std::optional<double> cell(const std::optional<double>& number) {
  return number ? std::optional(cell(*number)) : std::nullopt;
}

/// @throws std::invalid_argument  for a text with a zero byte, which PostgreSQL does not know.
inline const std::string& cell(const std::string& text) {
  if (text.find('\0') != std::string::npos) {
    throw std::invalid_argument("store: expected a text without zero bytes");
  }
  return text;
}

}  // namespace gonio

#include "reports/share_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

constexpr int most_decimals = 6;

/// Decimals that show so many digits of a number.
int decimals_for(double value, int digits, int most) {
  return std::isfinite(value) && value != 0.0
             ? std::clamp(digits - 1 - int(std::floor(std::log10(std::abs(value)))), 0, most)
             : digits;
}

}  // namespace

std::string count_text(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string times_words(std::uint64_t count) {
  return count == 0   ? "never"
         : count == 1 ? "once"
         : count == 2 ? "twice"
                      : fmt::format("{} times", count);
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = char(text.front() - 'a' + 'A');
  }
  return text;
}

std::string value_text(double value, double spread) {
  constexpr int digits = 2;
  return std::isfinite(value) ? fixed_text(value, decimals_for(spread, digits, most_decimals))
                              : "-";
}

std::string spread_text(double spread) {
  constexpr int digits = 3;
  constexpr double tiny = 1e-4;  // better by its power of ten
  return std::isfinite(spread) && spread != 0.0 && std::abs(spread) < tiny
             ? fmt::format("{:.1e}", spread)
         : std::isfinite(spread) ? fixed_text(spread, decimals_for(spread, digits, most_decimals))
                                 : "-";
}

std::string index_text(const std::optional<Estimate>& index) {
  const auto text = [](double value) { return std::isfinite(value) ? fixed_text(value, 2) : "-"; };
  return index
             ? fmt::format("{} ({} to {})", text(index->value), text(index->low), text(index->high))
             : "-";
}

std::string share_text(double share) {
  if (!std::isfinite(share)) {
    return "-";
  }
  constexpr int most = 4;
  const double percent = 100.0 * share;
  const double rare = std::min(std::abs(percent), std::abs(100.0 - percent));
  constexpr double seen = 0.5e-4;
  return rare == 0.0   ? fmt::format("{:g} %", percent)
         : rare < seen ? (share < 0.5 ? "< 0.0001 %" : "> 99.9999 %")
                       : fixed_text(percent, decimals_for(rare, 2, most)) + " %";
}

std::string share_text(const Estimate& share) {
  const auto bare = [](double bound) {
    const std::string text = share_text(bound);
    return text.substr(0, text.find(" %"));
  };
  return fmt::format("{} ({} to {})", share_text(share.value), bare(share.low), bare(share.high));
}

std::string share_text(const std::optional<double>& share) {
  return share ? share_text(*share) : "-";
}

}  // namespace gonio

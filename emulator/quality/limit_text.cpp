#include "emulator/quality/limit_text.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace gonio {

namespace {

constexpr std::string_view plus_minus = "\xC2\xB1";  // U+00B1

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// A number, or what is no number: nothing.
std::optional<double> number_in(std::string_view text) {
  return parse_quantity(trimmed(text), Dimension::number);
}

[[noreturn]] void fail(const YamlNode& node, const std::string& unit) {
  const std::string end = unit.empty() ? "" : " " + unit;
  node.fail(
      fmt::format("limits such as '85 +- 3{0}', '82 to 88{0}', '>= 80{0}' or '<= 10{0}'", end));
}

/// The text before the unit.
std::string_view without_unit(const YamlNode& node, std::string_view text,
                              const std::string& unit) {
  text = trimmed(text);
  if (!text.ends_with(unit)) {
    fail(node, unit);
  }
  return trimmed(text.substr(0, text.size() - unit.size()));
}

/// What stands on both sides of a separator; nothing if it is not there.
struct Pair {
  std::optional<double> first, second;
};
std::optional<Pair> split(std::string_view text, std::string_view separator) {
  const std::size_t place = text.find(separator);
  if (place == std::string_view::npos) {
    return std::nullopt;
  }
  return Pair{number_in(text.substr(0, place)), number_in(text.substr(place + separator.size()))};
}

LimitText about(const YamlNode& node, const std::string& unit, const Pair& pair) {
  if (!pair.first || !pair.second) {
    fail(node, unit);
  }
  if (!(*pair.second > 0.0)) {
    node.fail("a number > 0 after '+-'");
  }
  return {.limits = {.low = *pair.first - *pair.second, .high = *pair.first + *pair.second},
          .target = pair.first};
}

LimitText between(const YamlNode& node, const std::string& unit, const Pair& pair) {
  if (!pair.first || !pair.second) {
    fail(node, unit);
  }
  if (!(*pair.first < *pair.second)) {
    node.fail("a lower limit before 'to' that is less than the upper one after it");
  }
  return {.limits = {.low = pair.first, .high = pair.second}};
}

}  // namespace

LimitText read_limit_text(const YamlNode& node, const std::string& unit) {
  if (!node.is_scalar()) {
    fail(node, unit);
  }
  const std::string whole = node.text();
  const std::string_view text = without_unit(node, whole, unit);
  if (text.starts_with(">=") || text.starts_with("<=")) {
    const auto limit = number_in(text.substr(2));
    if (!limit) {
      fail(node, unit);
    }
    return text.front() == '>' ? LimitText{.limits = {.low = limit}}
                               : LimitText{.limits = {.high = limit}};
  }
  for (const std::string_view sign : {std::string_view("+-"), plus_minus}) {
    if (const auto pair = split(text, sign)) {
      return about(node, unit, *pair);
    }
  }
  if (const auto pair = split(text, " to ")) {
    return between(node, unit, *pair);
  }
  fail(node, unit);
}

}  // namespace gonio

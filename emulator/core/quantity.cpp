#include "emulator/core/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace gonio {

namespace {

struct Unit {
  std::string_view name;
  double factor;  // to the base unit
};

struct DimensionEntry {
  std::string_view noun;
  std::vector<Unit> units;
};

const DimensionEntry& entry(Dimension dimension) {
  static const DimensionEntry number{"a number", {{"", 1.0}}};
  static const DimensionEntry angle{
      "an angle", {{"deg", std::numbers::pi / 180.0}, {"rad", 1.0}, {"mrad", 1e-3}}};
  static const DimensionEntry length{"a length", {{"nm", 1.0}, {"um", 1e3}, {"mm", 1e6}}};
  static const DimensionEntry gloss{"a gloss value", {{"GU", 1.0}}};
  static const DimensionEntry time{"a time",
                                   {{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}, {"h", 3600.0}}};
  static const DimensionEntry temperature{"a temperature", {{"degC", 1.0}}};
  static const DimensionEntry difference{"a temperature difference", {{"K", 1.0}}};
  switch (dimension) {
    case Dimension::number:
      return number;
    case Dimension::angle:
      return angle;
    case Dimension::length:
      return length;
    case Dimension::gloss:
      return gloss;
    case Dimension::time:
      return time;
    case Dimension::temperature:
      return temperature;
    case Dimension::temperature_difference:
      return difference;
  }
  throw std::invalid_argument("entry: not a dimension");
}

}  // namespace

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (has_low && has_high) {
    return fmt::format(" in {}{}, {}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
  }
  if (has_low) {
    return fmt::format(" {} {}", low_open ? ">" : ">=", low);
  }
  return has_high ? fmt::format(" {} {}", high_open ? "<" : "<=", high) : std::string();
}

std::optional<double> parse_quantity(std::string_view text, Dimension dimension) {
  if (text.starts_with('+') && !text.starts_with("+-")) {
    text.remove_prefix(1);  // from_chars reads no plus sign
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) {
    return std::nullopt;
  }
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const Unit& known : entry(dimension).units) {
    if (unit == known.name) {
      return value * known.factor;
    }
  }
  return std::nullopt;
}

std::string expected_quantity(Dimension dimension) {
  const DimensionEntry& known = entry(dimension);
  if (dimension == Dimension::number) {
    return std::string(known.noun);
  }
  std::vector<std::string_view> names;
  for (const Unit& unit : known.units) {
    names.push_back(unit.name);
  }
  return fmt::format("{} ({})", known.noun, fmt::join(names, ", "));
}

}  // namespace gonio

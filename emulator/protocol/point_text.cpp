#include "emulator/protocol/point_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "emulator/core/quantity.hpp"
#include "emulator/protocol/register_codec.hpp"

namespace gonio {

namespace {

constexpr const char* no_bits = "none";

[[noreturn]] void fail(const Point& point, const std::string& expected, const std::string& found) {
  throw std::invalid_argument(
      fmt::format("{}: expected {}, found '{}'", point.id, expected, found));
}

std::string names_of(const std::vector<Symbol>& symbols, const char* separator) {
  std::vector<std::string> names;
  names.reserve(symbols.size());
  for (const Symbol& symbol : symbols) {
    names.push_back(symbol.name);
  }
  return fmt::format("{}", fmt::join(names, separator));
}

/// 3276.7, not 3276.7000000000003.
double without_last_bits(double value) {
  return parse_quantity(fmt::format("{:.12g}", value), Dimension::number).value_or(value);
}

/// What an integer point can hold, in its unit.
Range range_of(const Point& point) {
  const auto range = [&](auto limits) {
    return Range::closed(without_last_bits(double(limits.min()) * point.scale),
                         without_last_bits(double(limits.max()) * point.scale));
  };
  switch (point.type) {
    case PointType::int16:
      return range(std::numeric_limits<std::int16_t>());
    case PointType::uint16:
      return range(std::numeric_limits<std::uint16_t>());
    case PointType::int32:
      return range(std::numeric_limits<std::int32_t>());
    default:
      return range(std::numeric_limits<std::uint32_t>());
  }
}

const Symbol* symbol_named(const Point& point, const std::string& name) {
  const auto found = std::find_if(point.symbols.begin(), point.symbols.end(),
                                  [&](const Symbol& symbol) { return symbol.name == name; });
  return found == point.symbols.end() ? nullptr : &*found;
}

double parse_bits(const Point& point, const std::string& text) {
  double value = 0.0;
  for (std::size_t begin = 0; text != no_bits && begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    const Symbol* bit = symbol_named(point, text.substr(begin, end - begin));
    if (bit == nullptr) {
      fail(point,
           fmt::format("{}, or some of {} with + between them", no_bits,
                       names_of(point.symbols, ", ")),
           text);
    }
    const double weight = std::exp2(bit->value);
    value += std::fmod(std::floor(value / weight), 2.0) == 0.0 ? weight : 0.0;
    begin = end + 1;
  }
  return value;
}

double parse_symbol(const Point& point, const std::string& text) {
  if (const Symbol* symbol = symbol_named(point, text)) {
    return symbol->value;
  }
  const auto number = parse_quantity(text, Dimension::number);
  if (!number || find_symbol(point, *number) == nullptr) {
    fail(point, fmt::format("one of {}", names_of(point.symbols, ", ")), text);
  }
  return *number;
}

double parse_number(const Point& point, const std::string& text) {
  const auto number = parse_quantity(text, Dimension::number);
  if (point.type == PointType::float32) {
    constexpr double highest = std::numeric_limits<float>::max();
    if (!number || std::abs(*number) > highest) {
      fail(point, "a number", text);
    }
    return *number;
  }
  const Range range = range_of(point);
  const double steps = number.value_or(0.0) / point.scale;
  if (!number || !range.contains(*number) || std::abs(steps - std::round(steps)) > 1e-9) {
    fail(point,
         (point.scale == 1.0 ? "a whole number" : fmt::format("a multiple of {}", point.scale)) +
             range.text(),
         text);
  }
  return *number;
}

double parse_boolean(const Point& point, const std::string& text) {
  if (text != "true" && text != "false") {
    fail(point, "true or false", text);
  }
  return text == "true" ? 1.0 : 0.0;
}

}  // namespace

const Symbol* find_symbol(const Point& point, double value) {
  const auto found = std::find_if(point.symbols.begin(), point.symbols.end(),
                                  [&](const Symbol& symbol) { return symbol.value == value; });
  return found == point.symbols.end() ? nullptr : &*found;
}

std::vector<Symbol> symbols_on(const Point& point, double value) {
  std::vector<Symbol> on;
  std::copy_if(point.symbols.begin(), point.symbols.end(), std::back_inserter(on),
               [&](const Symbol& bit) {
                 return std::fmod(std::floor(value / std::exp2(bit.value)), 2.0) == 1.0;
               });
  return on;
}

std::string number_text(const Point& point, double value) {
  if (std::isnan(value)) {
    return "-";
  }
  if (std::isinf(value)) {
    return "over range";
  }
  if (point.type == PointType::boolean) {
    return value == 0.0 ? "false" : "true";
  }
  if (point.is_bit_field) {
    const auto on = symbols_on(point, value);
    return on.empty() ? no_bits : names_of(on, "+");
  }
  if (const Symbol* symbol = find_symbol(point, value)) {
    return symbol->name;
  }
  return fmt::format("{}", value);
}

std::vector<std::uint16_t> parse_value(const Point& point, const std::string& text) {
  std::vector<std::uint16_t> registers(static_cast<std::size_t>(point.registers));
  if (point.type == PointType::text) {
    if (text.size() > 2 * registers.size()) {
      fail(point, fmt::format("up to {} characters", 2 * registers.size()), text);
    }
    encode_text(text, registers);
    return registers;
  }
  encode_number(point,
                point.type == PointType::boolean ? parse_boolean(point, text)
                : point.is_bit_field             ? parse_bits(point, text)
                : !point.symbols.empty()         ? parse_symbol(point, text)
                                                 : parse_number(point, text),
                registers);
  return registers;
}

}  // namespace gonio

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// @return  the symbol of that number, or of that number of a bit; null if there is none.
[[nodiscard]] const Symbol* find_symbol(const Point& point, double value);

/// The symbols of the bits that are on.
[[nodiscard]] std::vector<Symbol> symbols_on(const Point& point, double value);

/// A number as people write it: "valid", "ready+result_valid", "none" for a field without a bit,
/// "92.3"; "-" for NaN and "over range" for infinity.
[[nodiscard]] std::string number_text(const Point& point, double value);

/// The registers, or the bit, of a value as people write it.
/// @param text  a name of a symbol or its number; names of bits with '+' between them, or none; a
///              number; true or false.
/// @throws std::invalid_argument  naming the point, what was expected and what was found.
[[nodiscard]] std::vector<std::uint16_t> parse_value(const Point& point, const std::string& text);

}  // namespace gonio

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/statistics/estimate.hpp"

// How counts, spreads and shares are put into words. Nothing is escaped here.

namespace gonio {

/// e.g. "1 panel", "12 panels".
[[nodiscard]] std::string count_text(std::uint64_t count, const std::string& noun);
/// e.g. "never", "once", "twice", "3 times".
[[nodiscard]] std::string times_words(std::uint64_t count);
/// With a capital at its beginning, if that is a plain letter.
[[nodiscard]] std::string capitalised(std::string text);
/// A value to the decimals that show two digits of its spread; "-" for what is no number.
[[nodiscard]] std::string value_text(double value, double spread);
/// A spread, or another number that is small, to three digits.
[[nodiscard]] std::string spread_text(double spread);
/// e.g. "1.33 (1.21 to 1.45)"; "-" for nothing.
[[nodiscard]] std::string index_text(const std::optional<Estimate>& index);
/// A share of lots or panels in %, to two digits, e.g. "0.42 %"; so is what it lacks of 100 %.
[[nodiscard]] std::string share_text(double share);
/// e.g. "0.42 % (0.25 to 0.66)".
[[nodiscard]] std::string share_text(const Estimate& share);
/// The same; "-" for nothing.
[[nodiscard]] std::string share_text(const std::optional<double>& share);

}  // namespace gonio

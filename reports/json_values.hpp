#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "emulator/core/input_error.hpp"
#include "emulator/statistics/estimate.hpp"

// What JSON reports share. Only writers of JSON include it.

namespace gonio {

/// Null where there is nothing; dump() makes null of what JSON has no number for.
inline nlohmann::ordered_json json_of(const std::optional<double>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json json_of(const Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

inline nlohmann::ordered_json json_of(const std::optional<Estimate>& estimate) {
  return estimate ? json_of(*estimate) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json json_of(const SourceMark& mark) {
  return {{"file", mark.file}, {"line", mark.line}, {"column", mark.column}};
}

}  // namespace gonio

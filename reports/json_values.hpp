#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

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

inline nlohmann::ordered_json json_of(const Eigen::ArrayXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

/// As a report prints it. Bytes that are no UTF-8, which the name of a file may have, become
/// U+FFFD.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gonio

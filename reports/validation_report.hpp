#pragma once

#include <string>

#include "emulator/goniometry/validation.hpp"

namespace gonio {

/// What was printed beside what is computed, in tables for people.
[[nodiscard]] std::string validation_text(const ValidationPlan& plan,
                                          const ValidationResult& result, bool styled);

/// Schema gonio/validation_result/1, numbers at full precision.
[[nodiscard]] std::string validation_json(const ValidationPlan& plan,
                                          const ValidationResult& result);

/// One row for each spectrum, numbers at full precision.
[[nodiscard]] std::string validation_csv(const ValidationPlan& plan,
                                         const ValidationResult& result);

/// A page of its own, with the spectra as charts.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string validation_page(const ValidationPlan& plan,
                                          const ValidationResult& result);

}  // namespace gonio

#pragma once

#include <string>
#include <vector>

#include "emulator/goniometry/fit_comparison.hpp"
#include "emulator/goniometry/fit_observations.hpp"

namespace gonio {

/// Models fitted to observations, as they are told of.
struct FitReport {
  std::string title;
  std::string instrument = {};  ///< id; empty where a BRDF was fitted
  std::string index = {};       ///< the refractive index, as YAML has it in a sample file
  FitObservations observations;
  std::vector<SurfaceFit> fits = {};
  FitComparison comparison = {};
};

/// Parameters, comparison and deviations, in tables for people.
[[nodiscard]] std::string fit_text(const FitReport& report, bool styled);

/// Schema gonio/fit/1, numbers at full precision.
[[nodiscard]] std::string fit_json(const FitReport& report);

/// One row for each observation and model: what was observed, what the model gives, the residual.
[[nodiscard]] std::string fit_csv(const FitReport& report);

/// A page of its own, with data, fitted curves and residuals as charts.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string fit_page(const FitReport& report);

/// A sample file with the parameters of the best model.
[[nodiscard]] std::string fit_sample(const FitReport& report);

}  // namespace gonio

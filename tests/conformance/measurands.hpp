#pragma once

#include <map>
#include <set>
#include <string>

#include "tests/conformance/case.hpp"

namespace gonio::conformance {

/// What reading `when` leaves behind besides the measurement.
struct MeasurandContext {
  std::set<std::string> samples = {};  ///< that have to be at hand
  bool is_evaluation = false;          ///< needs no device
};

/// Reads the arguments of a measurement and returns what carries it out.
using MeasurandReader = Measurement (*)(YamlMap& when, MeasurandContext& context);

/// All that can be measured, by name: a stated set-up, readings of a device, evaluations.
[[nodiscard]] const std::map<std::string, MeasurandReader>& measurands();

// Its parts, each in a file of its own.
[[nodiscard]] std::map<std::string, MeasurandReader> setup_measurands();
[[nodiscard]] std::map<std::string, MeasurandReader> reading_measurands();
[[nodiscard]] std::map<std::string, MeasurandReader> statistics_measurands();
[[nodiscard]] std::map<std::string, MeasurandReader> evaluation_measurands();

}  // namespace gonio::conformance

#pragma once

#include "emulator/core/interval.hpp"

namespace gonio {

/// Global risks of a decision about one item, JCGM 106:2012, 9.5.
struct GlobalRisks {
  double consumer = 0.0;  ///< probability that an item does not conform and is accepted
  double producer = 0.0;  ///< probability that an item conforms and is rejected
};
/// Of items of normal distribution, measured with a normal error, accepted within `acceptance`,
/// which may be empty: low > high.
/// @param sd  >= 0.   @param u  standard uncertainty of a measurement, >= 0.
/// @throws std::domain_error  for any other.
[[nodiscard]] GlobalRisks global_risks(double mean, double sd, double u, const Interval& tolerance,
                                       const Interval& acceptance);

}  // namespace gonio

#pragma once

#include <cstddef>

namespace gonio {

/// A number found from a sample, with its confidence interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0, high = 0.0;

  bool operator==(const Estimate&) const = default;
};

/// The share of successes among trials, with the exact interval of Clopper and Pearson.
/// @param confidence  in (0, 1).
/// @throws std::domain_error  for no trials, or more successes than trials.
[[nodiscard]] Estimate proportion(std::size_t successes, std::size_t trials,
                                  double confidence = 0.95);

}  // namespace gonio

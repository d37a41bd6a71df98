#pragma once

#include <cstddef>
#include <cstdint>

namespace gonio {

/// Standard deviations of a hierarchy: readings in panels in lots.
struct NestedSpread {
  std::uint64_t lots = 0, panels = 0, readings = 0;
  double mean = 0.0;  ///< of all readings
  double sd_lots = 0.0, sd_panels = 0.0, sd_readings = 0.0;
  std::uint64_t freedom_lots = 0, freedom_panels = 0, freedom_readings = 0;
};

/// Components of variance by analysis of variance, not balanced in general, in memory that does not
/// grow. Negative estimates count as 0; what has no degree of freedom is 0, and the level above
/// takes its part: with one reading a panel, sd_panels holds the readings' spread as well.
/// @see Searle, Casella, McCulloch, Variance Components, method of Henderson I for nested data
class NestedVariance {
 public:
  /// A panel. Panels of a lot come together.
  /// @param n  readings, >= 1.   @param standard_deviation  of them, 0 for one.
  /// @throws std::domain_error  for no readings, or numbers that are none.
  void add(std::uint64_t lot, std::size_t n, double mean, double standard_deviation);
  [[nodiscard]] NestedSpread result() const;

 private:
  // Mean and sum of squared deviations of values with weights, as they come.
  struct WeightedMean {
    double total = 0.0, squares_of_weights = 0.0, mean = 0.0, sum_of_squares = 0.0;
    void add(double weight, double value);
  };
  struct Lots {
    WeightedMean means = {};
    double within = 0.0;             // sum of squares of panels in lots
    double squares_of_panels = 0.0;  // sum of n_ij^2
    double squares_by_lot = 0.0;     // sum of n_ij^2 / n_i
    void add(const WeightedMean& lot);
  };

  std::uint64_t lots_ = 0, panels_ = 0, readings_ = 0;
  std::uint64_t lot_ = 0;  // which open_ is of
  WeightedMean open_;      // panels of the lot that has not ended
  Lots closed_;
  double within_panels_ = 0.0;
};

}  // namespace gonio

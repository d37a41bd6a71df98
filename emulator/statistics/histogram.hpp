#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gonio {

/// A histogram whose bins grow with what comes: never more than 256 of them, so that memory stays
/// the same however many values there are. The width is a power of two, the smallest that will do,
/// and bins begin at multiples of it: the same values give the same bins in any order.
class Histogram {
 public:
  struct Bins {
    double low = 0.0;    ///< of the first one
    double width = 0.0;  ///< 0: all values are equal to `low`
    std::vector<std::uint64_t> counts = {};
  };
  /// @throws std::domain_error  for a value that is not finite.
  void add(double value);
  /// At most so many bins, neighbours joined; none without values.
  /// @throws std::domain_error  for most = 0.
  [[nodiscard]] Bins bins(std::size_t most = 40) const;

 private:
  [[nodiscard]] std::int64_t index_of(double value) const;
  void begin_bins(double other);
  void widen();

  std::uint64_t values_ = 0;
  double only_value_ = 0.0;  // as long as all are equal: then there are no bins
  int exponent_ = 0;         // the width is 2^exponent_
  std::int64_t first_ = 0;   // the first bin begins at first_ 2^exponent_
  std::vector<std::uint64_t> counts_;
};

}  // namespace gonio

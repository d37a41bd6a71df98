#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gonio {

/// Points of a chart as they are shown: all of them while they are few, else neighbours together.
struct ChartPoint {
  std::uint64_t first = 1, last = 1;  ///< from 1
  double lowest = 0.0, mean = 0.0, highest = 0.0;
};

/// Points to show, in memory that does not grow: when there are 400 of them, each two neighbours
/// become one, and from then on one takes twice as many.
class ChartPoints {
 public:
  static constexpr std::size_t most = 400;
  /// @param number  above that of the last one.
  void add(std::uint64_t number, double value);
  [[nodiscard]] std::vector<ChartPoint> result() const;

 private:
  struct Bucket {
    ChartPoint point;
    std::uint64_t values = 1;
  };
  static void join(Bucket& to, const Bucket& next);

  std::uint64_t size_ = 1;  // of a full bucket, in values
  std::vector<Bucket> buckets_;
};

}  // namespace gonio

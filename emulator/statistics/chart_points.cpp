#include "emulator/statistics/chart_points.hpp"

#include <algorithm>

namespace gonio {

void ChartPoints::join(Bucket& to, const Bucket& next) {
  to.values += next.values;
  to.point.last = next.point.last;
  to.point.lowest = std::min(to.point.lowest, next.point.lowest);
  to.point.highest = std::max(to.point.highest, next.point.highest);
  to.point.mean += (next.point.mean - to.point.mean) * (double(next.values) / double(to.values));
}

void ChartPoints::add(std::uint64_t number, double value) {
  const Bucket one{.point = {number, number, value, value, value}};
  if (!buckets_.empty() && buckets_.back().values < size_) {
    join(buckets_.back(), one);
    return;
  }
  if (buckets_.size() == most) {
    for (std::size_t i = 0; i < most / 2; ++i) {
      join(buckets_[2 * i], buckets_[2 * i + 1]);
      buckets_[i] = buckets_[2 * i];
    }
    buckets_.resize(most / 2);
    size_ *= 2;
  }
  buckets_.push_back(one);
}

std::vector<ChartPoint> ChartPoints::result() const {
  std::vector<ChartPoint> points;
  for (const Bucket& bucket : buckets_) {
    points.push_back(bucket.point);
  }
  return points;
}

}  // namespace gonio

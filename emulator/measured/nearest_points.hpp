#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace gonio {

/// Finds the points next to a place, in a k-d tree.
class NearestPoints {
 public:
  /// @param points  shape (n, n_dimensions).
  explicit NearestPoints(Eigen::ArrayXXd points);

  [[nodiscard]] Eigen::Index size() const { return points_.rows(); }
  /// The `count` nearest points, or all if they are fewer: squares of their distances, and their
  /// rows; the nearest first.
  void find(const Eigen::ArrayXd& place, std::size_t count,
            std::vector<std::pair<double, Eigen::Index>>& nearest) const;

 private:
  struct Search;
  void order(Eigen::Index begin, Eigen::Index end, int depth);
  void search(Eigen::Index begin, Eigen::Index end, int depth, Search& search) const;

  Eigen::ArrayXXd points_;
  std::vector<Eigen::Index> tree_;  ///< rows; the middle of a range divides it
};

}  // namespace gonio

#include "emulator/measured/nearest_points.hpp"

#include <algorithm>
#include <numeric>

namespace gonio {

using Eigen::Index;

struct NearestPoints::Search {
  const Eigen::ArrayXd& place;
  std::size_t count;
  std::vector<std::pair<double, Index>>& heap;  ///< the farthest first

  [[nodiscard]] bool reaches(double square) const {
    return heap.size() < count || square < heap.front().first;
  }
  void offer(double square, Index row) {
    if (!reaches(square)) {
      return;
    }
    if (heap.size() == count) {
      std::ranges::pop_heap(heap);
      heap.pop_back();
    }
    heap.emplace_back(square, row);
    std::ranges::push_heap(heap);
  }
};

NearestPoints::NearestPoints(Eigen::ArrayXXd points)
    : points_(std::move(points)), tree_(std::size_t(points_.rows())) {
  std::iota(tree_.begin(), tree_.end(), Index(0));
  order(0, points_.rows(), 0);
}

void NearestPoints::order(Index begin, Index end, int depth) {
  if (end - begin < 2) {
    return;
  }
  const Index middle = begin + (end - begin) / 2;
  const Index axis = depth % points_.cols();
  std::nth_element(tree_.begin() + begin, tree_.begin() + middle, tree_.begin() + end,
                   [&](Index a, Index b) { return points_(a, axis) < points_(b, axis); });
  order(begin, middle, depth + 1);
  order(middle + 1, end, depth + 1);
}

void NearestPoints::search(Index begin, Index end, int depth, Search& search) const {
  if (begin >= end) {
    return;
  }
  const Index middle = begin + (end - begin) / 2;
  const Index row = tree_[std::size_t(middle)], axis = depth % points_.cols();
  search.offer((points_.row(row).transpose() - search.place).square().sum(), row);
  const double beyond = search.place[axis] - points_(row, axis);
  const auto search_side = [&](bool is_low) {
    this->search(is_low ? begin : middle + 1, is_low ? middle : end, depth + 1, search);
  };
  search_side(beyond < 0.0);
  if (search.reaches(beyond * beyond)) {
    search_side(beyond >= 0.0);
  }
}

void NearestPoints::find(const Eigen::ArrayXd& place, std::size_t count,
                         std::vector<std::pair<double, Index>>& nearest) const {
  nearest.clear();
  Search search{.place = place, .count = count, .heap = nearest};
  this->search(0, points_.rows(), 0, search);
  std::ranges::sort_heap(nearest);
}

}  // namespace gonio

#include "emulator/integration/cubature.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Differences below this share of the whole are rounding; halving a cell would not lessen them.
constexpr double rounding = 2e-15;

struct Axis {
  ArrayXd node, kronrod, gauss;

  /// The rule of n Gauss points on [low, high], or one node of weight 1 if that is a point.
  Axis(double low, double high, int n) {
    if (low == high) {
      node = ArrayXd::Constant(1, low);
      kronrod = gauss = ArrayXd::Ones(1);
      return;
    }
    const KronrodRule& rule = kronrod_rule(n);
    const double half = 0.5 * (high - low);
    node = 0.5 * (high + low) + half * rule.node;
    kronrod = half * rule.kronrod;
    gauss = half * rule.gauss;
  }
};

struct HeapCell {
  Cell cell;
  CellEstimate estimate;
  [[nodiscard]] double error() const { return estimate.error_p + estimate.error_q; }
  bool operator<(const HeapCell& other) const { return error() < other.error(); }
};

/// Ascending breaks from low to high, both included, no two closer than a billionth of the whole.
std::vector<double> edges(double low, double high, std::vector<double> breaks) {
  if (low == high) {
    return {low, high};
  }
  std::sort(breaks.begin(), breaks.end());
  const double least = 1e-9 * (high - low);
  std::vector<double> result{low};
  for (const double x : breaks) {
    if (x > result.back() + least && x < high - least) {
      result.push_back(x);
    }
  }
  result.push_back(high);
  return result;
}

}  // namespace

void CellNodes::place(const Region& region, const Cell& cell, int rule_p, int rule_q) {
  const Axis p(cell.p_low, cell.p_high, rule_p);
  const Region::Row middle = region.row(0.5 * (cell.p_low + cell.p_high));
  const bool is_line = middle.v_low == middle.v_high;
  const Axis q = is_line ? Axis(0.0, 0.0, rule_q) : Axis(cell.q_low, cell.q_high, rule_q);
  const Index rows = p.node.size();
  const Index columns = q.node.size();
  for (ArrayXd* array : {&u, &v, &weight, &gauss_p, &gauss_q}) {
    array->resize(rows * columns);
  }
  for (Index a = 0; a < rows; ++a) {
    const Region::Row row = region.row(p.node(a));
    const double half = 0.5 * (row.v_high - row.v_low);
    const double area = half < 0.0 ? 0.0 : row.du_dp * (is_line ? 1.0 : half);
    const auto part = Eigen::seqN(a * columns, columns);
    u(part) = row.u;
    v(part) = 0.5 * (row.v_high + row.v_low) + half * q.node;
    weight(part) = area * p.kronrod(a) * q.kronrod;
    gauss_p(part) = area * p.gauss(a) * q.kronrod;
    gauss_q(part) = area * p.kronrod(a) * q.gauss;
  }
}

Integral integrate(const Region& region, std::vector<double> p_breaks, std::vector<double> q_breaks,
                   const std::function<CellEstimate(const Cell&)>& evaluate, double tolerance,
                   std::size_t most_cells) {
  const auto ps = edges(region.p_low(), region.p_high(), std::move(p_breaks));
  const auto qs = edges(-1.0, 1.0, std::move(q_breaks));
  std::vector<HeapCell> cells;
  double error = 0.0;
  double size = 0.0;
  const auto add = [&](const Cell& cell) {
    cells.push_back({cell, evaluate(cell)});
    error += cells.back().error();
    size += std::abs(cells.back().estimate.value(0));
    std::push_heap(cells.begin(), cells.end());
  };
  for (std::size_t a = 0; a + 1 < ps.size(); ++a) {
    for (std::size_t b = 0; b + 1 < qs.size(); ++b) {
      add({ps[a], ps[a + 1], qs[b], qs[b + 1]});
    }
  }
  while (error > tolerance && cells.size() < most_cells &&
         cells.front().error() > rounding * size) {
    std::pop_heap(cells.begin(), cells.end());
    const HeapCell worst = std::move(cells.back());
    cells.pop_back();
    error -= worst.error();
    size -= std::abs(worst.estimate.value(0));
    Cell left = worst.cell;
    Cell right = worst.cell;
    if (worst.estimate.error_p > worst.estimate.error_q) {
      left.p_high = right.p_low = 0.5 * (left.p_low + left.p_high);
    } else {
      left.q_high = right.q_low = 0.5 * (left.q_low + left.q_high);
    }
    add(left);
    add(right);
  }
  Integral result{.value = Eigen::VectorXd::Zero(cells.front().estimate.value.size())};
  for (const HeapCell& cell : cells) {
    result.value += cell.estimate.value;
    result.error += cell.error();
  }
  return result;
}

}  // namespace gonio

#include "emulator/integration/cubature.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Differences below this share of the whole are rounding; halving a cell would not lessen them.
constexpr double rounding = 2e-15;

/// Both rules may miss part of what is small against their spacing, e.g. a kink in a corner; there
/// the error was found up to 3.5 times their difference. Elsewhere it is far below it.
constexpr double safety = 5.0;

/// One axis of a square rule.
KronrodRule axis_rule(bool has_extent, int gauss_points) {
  if (has_extent) {
    return kronrod_rule(gauss_points);
  }
  return {.node = ArrayXd::Zero(1), .kronrod = ArrayXd::Ones(1), .gauss = ArrayXd::Ones(1)};
}

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

SquareRule::SquareRule(const Region& region, int gauss_points_p, int gauss_points_q) {
  const KronrodRule along_p = axis_rule(region.has_extent_p(), gauss_points_p);
  const KronrodRule along_q = axis_rule(region.has_extent_q(), gauss_points_q);
  const Index rows = along_p.node.size();
  const Index columns = along_q.node.size();
  columns_ = columns;
  constexpr Index vector_length = 8;
  for (ArrayXd* array : {&p, &q, &weight, &less_gauss_p, &less_gauss_q}) {
    array->setZero((rows * columns + vector_length - 1) / vector_length * vector_length);
  }
  for (Index row = 0; row < rows; ++row) {
    const auto part = Eigen::seqN(row * columns, columns);
    p(part) = along_p.node(row);
    q(part) = along_q.node;
    weight(part) = along_p.kronrod(row) * along_q.kronrod;
    less_gauss_p(part) = (along_p.kronrod(row) - along_p.gauss(row)) * along_q.kronrod;
    less_gauss_q(part) = along_p.kronrod(row) * (along_q.kronrod - along_q.gauss);
  }
}

void CellNodes::place(const Region& region, const Cell& cell, const SquareRule& rule) {
  const Index n = rule.size();
  u.resize(n);
  v.resize(n);
  area.resize(n);
  const double middle_p = 0.5 * (cell.p_high + cell.p_low);
  const double half_p = 0.5 * (cell.p_high - cell.p_low);
  const double middle_q = 0.5 * (cell.q_high + cell.q_low);
  const double half_q = 0.5 * (cell.q_high - cell.q_low);
  const double size_p = region.has_extent_p() ? half_p : 1.0;
  if (region.has_equal_rows()) {
    const Region::Row any = region.row(middle_p);
    const double half_v = 0.5 * (any.v_high - any.v_low);
    u = middle_p + half_p * rule.p;
    v = 0.5 * (any.v_high + any.v_low) + half_v * (middle_q + half_q * rule.q);
    area = size_p * (region.has_extent_q() ? half_v * half_q : 1.0);
    return;
  }
  Region::Row row{};
  for (Index j = 0; j < n; ++j) {
    if (j == 0 || rule.p(j) != rule.p(j - 1)) {
      row = region.row(middle_p + half_p * rule.p(j));
    }
    const double half_v = 0.5 * (row.v_high - row.v_low);
    const double size_q = region.has_extent_q() ? half_v * half_q : 1.0;
    u(j) = row.u;
    v(j) = 0.5 * (row.v_high + row.v_low) + half_v * (middle_q + half_q * rule.q(j));
    area(j) = half_v < 0.0 ? 0.0 : size_p * row.du_dp * size_q;
  }
}

void CellEstimate::set_errors(const SquareRule& rule, const ArrayXd& control) {
  error_p = safety * std::abs((rule.less_gauss_p * control).sum());
  error_q = safety * std::abs((rule.less_gauss_q * control).sum());
}

Integral integrate(const Region& region, std::vector<double> p_breaks, std::vector<double> q_breaks,
                   const std::function<CellEstimate(const Cell&)>& evaluate, double tolerance,
                   std::size_t& budget) {
  const auto ps = edges(region.p_low(), region.p_high(), std::move(p_breaks));
  const auto qs = edges(-1.0, 1.0, std::move(q_breaks));
  std::vector<HeapCell> cells;
  double error = 0.0;
  double size = 0.0;
  const auto add = [&](const Cell& cell) {
    budget -= std::min<std::size_t>(budget, 1);
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
  while (error > tolerance && budget > 0 && cells.front().error() > rounding * size) {
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

#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "emulator/integration/kronrod.hpp"
#include "emulator/integration/region.hpp"

namespace gonio {

/// A cell of a region: p in [p_low, p_high]; of each row the part from the share q_low to the share
/// q_high, both in [-1, 1].
struct Cell {
  double p_low, p_high, q_low, q_high;
};

/// The product of two Kronrod rules on the square [-1, 1]^2; an axis without extent has one node of
/// weight 1. Filled up to whole vectors of the processor with nodes of weight 0.
struct SquareRule {
  Eigen::ArrayXd p, q;          ///< nodes, shape (n)
  Eigen::ArrayXd weight;        ///< Kronrod in both axes, shape (n)
  Eigen::ArrayXd less_gauss_p;  ///< the same less Gauss in p and Kronrod in q
  Eigen::ArrayXd less_gauss_q;  ///< the same less Kronrod in p and Gauss in q

  SquareRule(const Region& region, int gauss_points_p, int gauss_points_q);
  [[nodiscard]] Eigen::Index size() const { return p.size(); }
  /// The index of the node (p(j), -q(j)).
  [[nodiscard]] Eigen::Index opposite_in_q(Eigen::Index j) const {
    return j - j % columns_ + columns_ - 1 - j % columns_;
  }

 private:
  Eigen::Index columns_;  ///< nodes in q for each node in p
};

/// The nodes of a rule in a cell.
struct CellNodes {
  Eigen::ArrayXd u, v;
  Eigen::ArrayXd area;  ///< du dv / (dp dq of the square), 0 outside the region

  void place(const Region& region, const Cell& cell, const SquareRule& rule);
};

/// An integral over a cell, and by how much the rule of lower order differs in each axis.
struct CellEstimate {
  Eigen::VectorXd value;
  double error_p = 0.0;
  double error_q = 0.0;

  /// @param control  the function whose error counts, at the nodes, times their area.
  void set_errors(const SquareRule& rule, const Eigen::ArrayXd& control);
};

/// An integral, and a bound on the error of the functional that its integrator watches.
struct Integral {
  Eigen::VectorXd value;
  double error = 0.0;
};

/// Integrates over a region: starts from the cells between the breaks, and halves the one of the
/// largest error across its worse axis until the sum of the errors is below the tolerance.
///
/// @param p_breaks, q_breaks  inside the region, in any order; the edges are added.
/// @param evaluate            estimates a cell.
/// @param tolerance           on the sum of errors; the result says if it was not reached.
/// @param budget              of cells to estimate, lessened by each; where to give up. The cells
///                            between the breaks are estimated even without it.
[[nodiscard]] Integral integrate(const Region& region, std::vector<double> p_breaks,
                                 std::vector<double> q_breaks,
                                 const std::function<CellEstimate(const Cell&)>& evaluate,
                                 double tolerance, std::size_t& budget);

}  // namespace gonio

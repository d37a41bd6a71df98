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

/// The nodes of a cell and their weights, the size of the area they stand for included.
struct CellNodes {
  Eigen::ArrayXd u, v;
  Eigen::ArrayXd weight;   ///< Kronrod in both axes
  Eigen::ArrayXd gauss_p;  ///< Gauss in p, Kronrod in q
  Eigen::ArrayXd gauss_q;  ///< Kronrod in p, Gauss in q

  /// @param rule_p, rule_q  numbers of Gauss points; an axis without extent takes one node.
  void place(const Region& region, const Cell& cell, int rule_p, int rule_q);
};

/// An integral over a cell, and by how much the rule of lower order differs in each axis.
struct CellEstimate {
  Eigen::VectorXd value;
  double error_p = 0.0;
  double error_q = 0.0;
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
/// @param most_cells          where to give up.
[[nodiscard]] Integral integrate(const Region& region, std::vector<double> p_breaks,
                                 std::vector<double> q_breaks,
                                 const std::function<CellEstimate(const Cell&)>& evaluate,
                                 double tolerance, std::size_t most_cells);

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <numbers>

namespace gonio {

/// Two nodes, and the share of the second in what is linear between them.
struct Bracket {
  Eigen::Index first = 0, second = 0;
  double weight = 0.0;

  [[nodiscard]] Eigen::Index nearest() const { return weight < 0.5 ? first : second; }
};

/// The nodes about x; the outermost one beyond them. @param nodes  ascending, at least one.
[[nodiscard]] Bracket bracket(const Eigen::ArrayXd& nodes, double x);

/// The nodes about an angle, the first following the last after a turn.
/// @param nodes  [rad], ascending, at least one, in [0, 2 pi].   @param angle  in [0, 2 pi].
[[nodiscard]] Bracket bracket_on_circle(const Eigen::ArrayXd& nodes, double angle);

/// An angle [rad] by whole turns in [0, 2 pi).
[[nodiscard]] double in_one_turn(double angle);

}  // namespace gonio

#include "emulator/measured/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace gonio {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

Bracket bracket(const Eigen::ArrayXd& nodes, double x) {
  const Eigen::Index last = nodes.size() - 1;
  if (!(x > nodes[0])) {
    return {};
  }
  if (x >= nodes[last]) {
    return {.first = last, .second = last};
  }
  const double* const begin = nodes.data();
  const Eigen::Index second = std::upper_bound(begin, begin + nodes.size(), x) - begin;
  const double low = nodes[second - 1];
  return {.first = second - 1, .second = second, .weight = (x - low) / (nodes[second] - low)};
}

Bracket bracket_on_circle(const Eigen::ArrayXd& nodes, double angle) {
  const Eigen::Index last = nodes.size() - 1;
  if (angle >= nodes[0] && angle <= nodes[last]) {
    return bracket(nodes, angle);
  }
  const double gap = nodes[0] + turn - nodes[last];
  const double beyond = angle < nodes[0] ? angle + turn - nodes[last] : angle - nodes[last];
  return {.first = last, .second = 0, .weight = gap > 0.0 ? std::min(beyond / gap, 1.0) : 1.0};
}

double in_one_turn(double angle) {
  const double rest = std::fmod(angle, turn);
  const double positive = rest < 0.0 ? rest + turn : rest;
  return positive < turn ? positive : 0.0;
}

}  // namespace gonio

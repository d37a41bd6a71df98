#include "emulator/quality/normal_nodes.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

/// Beyond so many standard deviations a normal distribution has 1e-10.
constexpr double reach = 6.5;
constexpr int pieces = 8;  // of the whole, and about each place

}  // namespace

std::vector<NormalNode> normal_nodes(double sd, const std::vector<double>& places, double scale) {
  if (sd == 0.0) {
    return {{.x = 0.0, .weight = 1.0}};
  }
  std::vector<double> ends;
  for (int i = 0; i <= pieces; ++i) {
    const double z = reach * (2.0 * i / pieces - 1.0);
    ends.push_back(z);
    for (const double place : places) {
      ends.push_back(std::clamp((place + z * scale) / sd, -reach, reach));
    }
  }
  std::sort(ends.begin(), ends.end());
  using Rule = boost::math::quadrature::gauss<double, 15>;
  std::vector<NormalNode> nodes;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i - 1]), half = 0.5 * (ends[i] - ends[i - 1]);
    const auto add = [&](double t, double weight) {
      const double z = middle + half * t;
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
      nodes.push_back({.x = sd * z, .weight = weight * half * density});
    };
    // The rule is given by one half of it.
    for (std::size_t j = 0; half > 0.0 && j < Rule::abscissa().size(); ++j) {
      add(Rule::abscissa()[j], Rule::weights()[j]);
      if (Rule::abscissa()[j] != 0.0) {
        add(-Rule::abscissa()[j], Rule::weights()[j]);
      }
    }
  }
  return nodes;
}

}  // namespace gonio

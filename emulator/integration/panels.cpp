#include "emulator/integration/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace gonio {

namespace {

constexpr double growth = 3.0;   // of the distances between breaks
constexpr double sliver = 0.25;  // of the distance between a break and the peak

/// A Gauss rule of n points, and the logarithm of c in its error c (2r)^2n for a Gaussian exp(-x^2)
/// on a cell of half size r, relative to the cell's size: c = (n!)^3 / ((2n + 1) (2n)!^2).
struct GaussError {
  int n;
  double log_c;
};

std::array<GaussError, 8> make_gauss_errors() {
  std::array<GaussError, 8> errors{};
  std::size_t i = 0;
  for (const int n : {1, 2, 3, 4, 5, 7, 10, 15}) {
    double log_c = -std::log(2.0 * n + 1.0);
    for (int k = 1; k <= 2 * n; ++k) {
      log_c += (k <= n ? 1.0 : -2.0) * std::log(double(k));
    }
    errors[i++] = {n, log_c};
  }
  return errors;
}

/// The rule of at least so many points that takes the fewest nodes for a Gaussian of width 1 on
/// [-extent, extent].
AxisPlan plan_axis(double extent, double relative_tolerance, int least_points) {
  static const std::array<GaussError, 8> rules = make_gauss_errors();
  constexpr double end_of_gaussian = 5.0;
  AxisPlan best{.gauss_points = 0, .first_break = 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [n, log_c] : rules) {
    const double r = 0.5 * std::exp((std::log(relative_tolerance) - log_c) / (2.0 * n));
    const double graded =
        1.0 + 2.0 * std::ceil(std::log(std::max(extent / r, 1.0)) / std::log(growth));
    const double cells = std::max(graded, std::ceil(std::min(extent, end_of_gaussian) / r));
    if (n >= least_points && cells * (2.0 * n + 1.0) < least) {
      least = cells * (2.0 * n + 1.0);
      best = {.gauss_points = n, .first_break = r};
    }
  }
  return best;
}

/// Breaks on both sides of `centre`, at distances that grow from `first` up to `reach`.
void add_graded(double centre, double first, double reach, double low, double high,
                std::vector<double>& breaks) {
  if (!(first > 0.0 && first < high - low)) {
    return;
  }
  const double farthest =
      std::min(std::max(std::abs(centre - low), std::abs(centre - high)), reach);
  for (double distance = first; distance < farthest; distance *= growth) {
    for (const double x : {centre - distance, centre + distance}) {
      // What a break would cut off by the edge, if it is small, the rule of its neighbour takes
      // too.
      const double least = sliver * distance;
      if (x > low + least && x < high - least) {
        breaks.push_back(x);
      }
    }
  }
}

}  // namespace

LobeWidth::LobeWidth(const SlopeWidth& slope, double cos_theta_d)
    : u(2.0 * slope.x), v(2.0 * slope.y * std::abs(cos_theta_d)) {}

LobeWidth LobeWidth::turned() const {
  LobeWidth result = *this;
  std::swap(result.u, result.v);
  return result;
}

std::optional<Peak> peak_in(const Frame& frame, const Vector3& omega, const LobeWidth& width) {
  constexpr double widest = 0.5;  // cosines alone change over that
  const auto point = project(frame, omega);
  if (!point) {
    return std::nullopt;
  }
  const double stretch = 1.0 + point->u * point->u + point->v * point->v;
  return Peak{*point, std::min(width.u * stretch, widest), std::min(width.v * stretch, widest)};
}

std::vector<Peak> receptor_edges(const MeasuringGeometry& geometry, const LobeWidth& width) {
  const Aperture edge = geometry.receptor.mirrored();
  const double middle_u = 0.5 * (edge.u_low() + edge.u_high());
  const double middle_v = 0.5 * (edge.v_low() + edge.v_high());
  std::vector<Peak> edges;
  for (const PlanePoint& at :
       {PlanePoint{edge.u_low(), middle_v}, PlanePoint{edge.u_high(), middle_v},
        PlanePoint{middle_u, edge.v_low()}, PlanePoint{middle_u, edge.v_high()}}) {
    const Vector3 omega = edge.frame().direction(at.u, at.v);
    const auto peak = peak_in(geometry.source.frame(), omega, width);
    if (!peak) {
      return {};
    }
    edges.push_back(*peak);
  }
  return edges;
}

std::optional<Peak> scale_over_source(const Aperture& source, const std::vector<Peak>& edges) {
  if (edges.empty()) {
    return std::nullopt;
  }
  const auto gap = [](double low, double high, double edge_a, double edge_b) {
    return std::max(0.0, std::min(low - std::min(edge_a, edge_b), std::max(edge_a, edge_b) - high));
  };
  const double gap_u = gap(source.u_low(), source.u_high(), edges[0].at.u, edges[1].at.u);
  const double gap_v = gap(source.v_low(), source.v_high(), edges[2].at.v, edges[3].at.v);
  return Peak{.at = {0.0, 0.0},
              .width_u = std::hypot(edges[0].width_u, gap_u),
              .width_v = std::hypot(edges[2].width_v, gap_v)};
}

Plan::Plan(const Aperture& aperture, const std::optional<Peak>& peak, double relative_tolerance) {
  const double half_u = 0.5 * (aperture.u_high() - aperture.u_low());
  const double half_v = 0.5 * (aperture.v_high() - aperture.v_low());
  // Rows of a circle are as long as cos p, and as thick: that asks for more of a rule than a wide
  // lobe does, or the circle would be halved again and again.
  constexpr int for_cos_squared = 7;  // 2e-8 of the integral over half a turn
  p = plan_axis(peak ? half_u / peak->width_u : 1.0, relative_tolerance,
                aperture.outline() == Aperture::Outline::circle ? for_cos_squared : 1);
  q = plan_axis(peak ? half_v / peak->width_v : 1.0, relative_tolerance, 1);
}

void Breaks::add_u(const Region& region, const Peak& peak, const AxisPlan& plan, double reach) {
  std::vector<double> us;
  add_graded(peak.at.u, plan.first_break * peak.width_u, reach * peak.width_u,
             region.row(region.p_low()).u, region.row(region.p_high()).u, us);
  for (const double u : us) {
    p.push_back(region.p_at(u));
  }
}

void Breaks::add_v(const Region& region, const Peak& peak, const AxisPlan& plan, double reach) {
  // Rows of a circle differ in length: the breaks fit the row nearest to the peak.
  const Region::Row nearest = region.row(region.p_at(peak.at.u));
  const Region::Row middle = region.row(0.5 * (region.p_low() + region.p_high()));
  const double half =
      0.5 * std::max(nearest.v_high - nearest.v_low, 0.01 * (middle.v_high - middle.v_low));
  if (half > 0.0) {
    const double centre = (peak.at.v - 0.5 * (nearest.v_high + nearest.v_low)) / half;
    const double width = peak.width_v / half;
    add_graded(centre, plan.first_break * width, reach * width, -1.0, 1.0, q);
  }
}

void Breaks::make_q_symmetric() {
  constexpr double closest = 1e-8;  // farther than cells may be narrow, so that none is dropped
  std::sort(q.begin(), q.end());
  std::vector<double> result;
  for (const double x : q) {
    if (x > closest && (result.empty() || x > result.back() + closest)) {
      result.push_back(x);
    }
  }
  q = result;
  std::transform(result.begin(), result.end(), std::back_inserter(q), std::negate<>());
}

}  // namespace gonio

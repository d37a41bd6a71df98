#include "emulator/integration/aperture_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/chebyshev.hpp"
#include "emulator/integration/cubature.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t most_receptor_cells = 4000;
constexpr std::size_t most_source_cells = 4000;
/// Rounding of sums of up to a million terms of like sign, relative to the sum.
constexpr double rounding = 2e-14;

/// How far breaks go, in widths of the lobe: through its tails, or where the receptor's edge cuts
/// it.
constexpr double to_the_edge = 1e9;
constexpr double past_the_edge = 5.0;

constexpr double growth = 3.0;  // of the distances between breaks

/// How one axis is cut and which rule it gets.
struct AxisPlan {
  int gauss_points;
  double first_break;  ///< of a graded series, in widths
};

/// The rule that takes the fewest nodes for a Gaussian exp(-x^2) on [-extent, extent]. With n
/// points on a cell of half size r, Gauss's error relative to the cell's size is about (2r)^2n
/// (n!)^3 / ((2n + 1) (2n)!^2).
AxisPlan plan_axis(double extent, double relative_tolerance) {
  constexpr double end_of_gaussian = 5.0;
  AxisPlan best{.gauss_points = 0, .first_break = 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (const int n : {1, 2, 3, 4, 5, 7, 10, 15}) {
    const double log_constant =
        3.0 * std::lgamma(n + 1.0) - 2.0 * std::lgamma(2.0 * n + 1.0) - std::log(2.0 * n + 1.0);
    const double r = 0.5 * std::exp((std::log(relative_tolerance) - log_constant) / (2.0 * n));
    const double graded =
        1.0 + 2.0 * std::ceil(std::log(std::max(extent / r, 1.0)) / std::log(growth));
    const double cells = std::max(graded, std::ceil(std::min(extent, end_of_gaussian) / r));
    if (cells * (2.0 * n + 1.0) < least) {
      least = cells * (2.0 * n + 1.0);
      best = {.gauss_points = n, .first_break = r};
    }
  }
  return best;
}

/// Where a lobe peaks in a tangent plane, and how far it spreads there.
struct Peak {
  PlanePoint at;
  double width_u, width_v;
};

std::optional<Peak> peak_in(const Frame& frame, const Vector3& omega, const SlopeWidth& slope,
                            double cos_theta_d) {
  constexpr double widest = 0.5;  // cosines alone change over that
  const auto point = project(frame, omega);
  if (!point) {
    return std::nullopt;
  }
  const double stretch = 1.0 + point->u * point->u + point->v * point->v;
  return Peak{*point, std::min(2.0 * slope.x * stretch, widest),
              std::min(2.0 * slope.y * std::abs(cos_theta_d) * stretch, widest)};
}

/// How both axes of a region are cut for a lobe.
struct Plan {
  AxisPlan p, q;

  Plan(const Aperture& aperture, const std::optional<Peak>& peak, double relative_tolerance) {
    const double half_u = 0.5 * (aperture.u_high() - aperture.u_low());
    const double half_v = 0.5 * (aperture.v_high() - aperture.v_low());
    p = plan_axis(peak ? half_u / peak->width_u : 1.0, relative_tolerance);
    q = plan_axis(peak ? half_v / peak->width_v : 1.0, relative_tolerance);
  }
};

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
      if (x > low && x < high) {
        breaks.push_back(x);
      }
    }
  }
}

struct Breaks {
  std::vector<double> p, q;

  /// Breaks in u and in v round a peak. @param reach  in widths.
  void add_u(const Region& region, const Peak& peak, const AxisPlan& plan, double reach) {
    std::vector<double> us;
    add_graded(peak.at.u, plan.first_break * peak.width_u, reach * peak.width_u,
               region.row(region.p_low()).u, region.row(region.p_high()).u, us);
    for (const double u : us) {
      p.push_back(region.p_at(u));
    }
  }
  void add_v(const Region& region, const Peak& peak, const AxisPlan& plan, double reach) {
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
};

/// Moments of one lobe over the receptor, for light from one direction: int g T_k cos r d omega_r.
class ReceptorIntegral {
 public:
  ReceptorIntegral(const Lobe& lobe, double parameter, const Aperture& receptor,
                   const ColourSeries& series, const VectorXd& functional, const Plan& plan)
      : lobe_(lobe),
        parameter_(parameter),
        region_(receptor),
        series_(series),
        functional_(functional),
        plan_(plan),
        rule_(region_, plan.p.gauss_points, plan.q.gauss_points) {}

  Integral operator()(const Vector3& omega_i, double tolerance) {
    const double cos_theta_i = omega_i.z();
    if (cos_theta_i <= 0.0) {
      return {.value = VectorXd::Zero(functional_.size())};
    }
    Breaks breaks;
    const SlopeWidth slope = lobe_.shape->slope_width(parameter_, cos_theta_i);
    if (const auto peak = peak_in(region_.frame(), mirrored(omega_i), slope, cos_theta_i)) {
      breaks.add_u(region_, *peak, plan_.p, to_the_edge);
      breaks.add_v(region_, *peak, plan_.q, to_the_edge);
    }
    return integrate(
        region_, std::move(breaks.p), std::move(breaks.q),
        [&](const Cell& cell) { return estimate(omega_i, cell); }, tolerance, most_receptor_cells);
  }

 private:
  CellEstimate estimate(const Vector3& omega_i, const Cell& cell) {
    nodes_.place(region_, cell, rule_);
    const Index n = rule_.size();
    omega_r_.resize(n);
    x_.resize(n);
    control_.resize(n);
    g_.resize(n);
    ArrayXd& value = nodes_.area;  // becomes g cos r d omega_r, but for the weights of the rule
    kernel::tangent_directions(region_.frame(), nodes_.u, nodes_.v, omega_r_, value);
    lobe_.shape->evaluate(parameter_, omega_i, omega_r_, g_);
    kernel::half_angle_argument(omega_i, omega_r_, series_.scale, series_.shift, x_);
    kernel::chebyshev_series(functional_, x_, control_);
    value *= g_;
    control_ *= value;
    CellEstimate result{.value = VectorXd::Zero(functional_.size())};
    result.set_errors(rule_, control_);
    value *= rule_.weight;
    kernel::add_chebyshev_moments(x_, value, result.value);
    return result;
  }

  const Lobe& lobe_;
  double parameter_;
  Region region_;
  const ColourSeries& series_;
  const VectorXd& functional_;
  Plan plan_;
  SquareRule rule_;
  CellNodes nodes_;
  DirectionBatch omega_r_;
  ArrayXd x_, g_, control_;
};

/// The middles of the receptor's edges in the tangent plane of the source, seen in the mirror. As a
/// function of the direction of incidence, what arrives in the receptor changes there, within the
/// width of the lobe. Low u, high u, low v, high v; none if an edge is out of sight.
std::vector<Peak> receptor_edges(const MeasuringGeometry& geometry, const SlopeWidth& slope) {
  const Aperture edge = geometry.receptor.mirrored();
  const double middle_u = 0.5 * (edge.u_low() + edge.u_high());
  const double middle_v = 0.5 * (edge.v_low() + edge.v_high());
  std::vector<Peak> edges;
  for (const PlanePoint& at :
       {PlanePoint{edge.u_low(), middle_v}, PlanePoint{edge.u_high(), middle_v},
        PlanePoint{middle_u, edge.v_low()}, PlanePoint{middle_u, edge.v_high()}}) {
    const Vector3 omega = edge.frame().direction(at.u, at.v);
    const auto peak =
        peak_in(geometry.source.frame(), omega, slope, geometry.source.frame().axis.z());
    if (!peak) {
      return {};
    }
    edges.push_back(*peak);
  }
  return edges;
}

/// The scale on which the receptor's signal changes over the source: the width of the lobe, or the
/// gap between the source image and the edges of the receptor if that is wider.
std::optional<Peak> smoothed(const Aperture& source, const std::vector<Peak>& edges) {
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

/// The same over the source too: int cos i d omega_i of the receptor's moments.
Integral lobe_moments(const Lobe& lobe, double parameter, const MeasuringGeometry& geometry,
                      const ColourSeries& series, const VectorXd& functional, double tolerance,
                      double incident) {
  const Index terms = functional.size();
  const Region source(geometry.source);
  const double relative = std::clamp(tolerance / incident, 1e-15, 1e-3);
  const Vector3& axis = geometry.source.frame().axis;
  const SlopeWidth slope = lobe.shape->slope_width(parameter, std::max(axis.z(), 0.0));
  const Plan receptor_plan(geometry.receptor,
                           peak_in(geometry.receptor.frame(), mirrored(axis), slope, axis.z()),
                           relative);
  ReceptorIntegral receptor(lobe, parameter, geometry.receptor, series, functional, receptor_plan);
  const auto edges = receptor_edges(geometry, slope);
  const Plan plan(geometry.source, smoothed(geometry.source, edges), relative);
  Breaks breaks;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i < 2) {
      breaks.add_u(source, edges[i], plan.p, past_the_edge);
    } else {
      breaks.add_v(source, edges[i], plan.q, past_the_edge);
    }
  }
  const double inner_tolerance = 0.25 * tolerance / incident;
  const SquareRule rule(source, plan.p.gauss_points, plan.q.gauss_points);
  const auto estimate = [&](const Cell& cell) {
    CellNodes nodes;
    nodes.place(source, cell, rule);
    const Index n = rule.size();
    DirectionBatch omega_i;
    omega_i.resize(n);
    ArrayXd& factor = nodes.area;  // becomes cos i d omega_i, but for the weights of the rule
    kernel::tangent_directions(source.frame(), nodes.u, nodes.v, omega_i, factor);
    ArrayXd control(n);
    CellEstimate result{.value = VectorXd::Zero(terms + 1)};  // the last one is the inner error
    for (Index j = 0; j < n; ++j) {
      const Integral inner = receptor({omega_i.x(j), omega_i.y(j), omega_i.z(j)}, inner_tolerance);
      control(j) = factor(j) * functional.dot(inner.value);
      const double weight = rule.weight(j) * factor(j);
      result.value.head(terms) += weight * inner.value;
      result.value(terms) += weight * inner.error;
    }
    result.set_errors(rule, control);
    return result;
  };
  Integral sum = integrate(source, std::move(breaks.p), std::move(breaks.q), estimate,
                           0.75 * tolerance, most_source_cells);
  sum.error += sum.value(terms);
  sum.value.conservativeResize(terms);
  return sum;
}

/// Flux of a lobe whose shape is the same at all wavelengths, or has the parameter given.
Flux flux_of_shape(const Lobe& lobe, double parameter, const MeasuringGeometry& geometry,
                   const ColourSeries& series, const VectorXd& functional, double tolerance,
                   double incident) {
  const Integral moments =
      lobe_moments(lobe, parameter, geometry, series, functional, tolerance, incident);
  return {.spectral = (series.coefficient.transpose() * moments.value).array(),
          .error = moments.error + std::abs(moments.value(0)) * series.truncation.maxCoeff()};
}

/// Flux of a lobe whose shape follows a parameter that changes with wavelength: the moments are
/// interpolated between Chebyshev points of the parameter, doubled until the flux settles.
Flux flux_of_changing_shape(const Lobe& lobe, const MeasuringGeometry& geometry,
                            const ColourSeries& series, const VectorXd& functional,
                            const ArrayXd& weight, double tolerance, double incident) {
  constexpr Index most_points = 65;
  const double low = lobe.shape_parameter.minCoeff();
  const double high = lobe.shape_parameter.maxCoeff();
  const double node_tolerance = 0.3 * tolerance;  // interpolation amplifies by less than 2
  if (high - low <= 1e-12 * high) {
    return flux_of_shape(lobe, low, geometry, series, functional, tolerance, incident);
  }
  const ArrayXd x = (2.0 * lobe.shape_parameter - (low + high)) / (high - low);
  std::vector<Integral> at_point;
  Flux before;
  for (Index n = 3;; n = 2 * n - 1) {
    const ArrayXd point = chebyshev_points(n);
    std::vector<Integral> now;
    Eigen::MatrixXd moments(functional.size(), n);
    double error = 0.0;
    for (Index j = 0; j < n; ++j) {  // every second point is one of the n before
      const double parameter = 0.5 * ((high + low) + (high - low) * point(j));
      now.push_back(!at_point.empty() && j % 2 == 0
                        ? at_point[std::size_t(j / 2)]
                        : lobe_moments(lobe, parameter, geometry, series, functional,
                                       node_tolerance, incident));
      moments.col(j) = now.back().value;
      error = std::max(error, 2.0 * now.back().error);
    }
    at_point = std::move(now);
    const Eigen::MatrixXd at_lambda = moments * chebyshev_interpolation(n, x).transpose();
    Flux flux{
        .spectral = series.coefficient.cwiseProduct(at_lambda).colwise().sum().transpose(),
        .error = error + at_lambda.row(0).cwiseAbs().maxCoeff() * series.truncation.maxCoeff()};
    if (n > 3) {
      const double change = (weight * (flux.spectral - before.spectral).abs()).sum();
      flux.error += change;
      if (change <= 0.3 * tolerance || n >= most_points) {
        return flux;
      }
    }
    before = flux;
  }
}

Flux lobe_flux(const Lobe& lobe, const MeasuringGeometry& geometry, const ArrayXd& weight,
               double tolerance, double incident) {
  const CosineRange range = half_angle_range(geometry);
  const ColourSeries series(lobe.colour, range.low, range.high, 0.02 * tolerance / incident);
  const VectorXd functional = series.coefficient * weight.matrix();
  return lobe.shape_parameter.size() == 0
             ? flux_of_shape(lobe, 0.0, geometry, series, functional, tolerance, incident)
             : flux_of_changing_shape(lobe, geometry, series, functional, weight, tolerance,
                                      incident);
}

/// int over a region of cos i times the reflectance of smooth interfaces.
Flux interface_flux(const Colour& reflectance, const Region& region, const CosineRange& range,
                    const ArrayXd& weight, double tolerance) {
  constexpr int order = 5;
  constexpr std::size_t most_cells = 4000;
  const ColourSeries series(reflectance, range.low, range.high, 0.02 * tolerance);
  const VectorXd functional = series.coefficient * weight.matrix();
  const SquareRule rule(region, order, order);
  CellNodes nodes;
  DirectionBatch omega;
  omega.resize(rule.size());
  ArrayXd control(rule.size());
  const auto estimate = [&](const Cell& cell) {
    nodes.place(region, cell, rule);
    ArrayXd& value = nodes.area;  // becomes cos i d omega_i, but for the weights of the rule
    kernel::tangent_directions(region.frame(), nodes.u, nodes.v, omega, value);
    const ArrayXd x = (series.scale * omega.z + series.shift).max(-1.0).min(1.0);
    kernel::chebyshev_series(functional, x, control);
    control *= value;
    CellEstimate result{.value = VectorXd::Zero(functional.size())};
    result.set_errors(rule, control);
    value *= rule.weight;
    kernel::add_chebyshev_moments(x, value, result.value);
    return result;
  };
  const Integral moments = integrate(region, region.corners(), {}, estimate, tolerance, most_cells);
  return {.spectral = (series.coefficient.transpose() * moments.value).array(),
          .error = moments.error + std::abs(moments.value(0)) * series.truncation.maxCoeff()};
}

/// The cosines of incidence within an aperture, or bounds on them.
CosineRange incidence_range(const Aperture& source) {
  const double theta = std::acos(std::clamp(source.frame().axis.z(), -1.0, 1.0));
  const double spread = source.radius().radians() + 1e-6;
  return {.low = std::max(std::cos(theta + spread), 0.0),
          .high = std::max(std::cos(std::max(theta - spread, 0.0)), 1e-6)};
}

}  // namespace

Flux ApertureIntegrator::reflected(const Surface& surface, const MeasuringGeometry& geometry,
                                   const ArrayXd& weight, double tolerance) const {
  const double terms = double(surface.lobes.size()) + (surface.interfaces.empty() ? 0.0 : 1.0);
  const double share = tolerance / std::max(terms, 1.0);
  Flux sum{.spectral = ArrayXd::Zero(surface.grid.size())};
  const auto add = [&](const Flux& flux) {
    sum.spectral += flux.spectral;
    sum.error += flux.error + rounding * (weight * flux.spectral).sum();
  };
  if (!surface.interfaces.empty()) {
    const Region overlap(geometry.source, geometry.receptor.mirrored());
    add(interface_flux([&](double c) { return surface.specular_reflectance(c); }, overlap,
                       incidence_range(geometry.source), weight, share));
  }
  const double incoming = incident(geometry.source);
  for (const Lobe& lobe : surface.lobes) {
    if (incoming > 0.0) {
      add(lobe_flux(lobe, geometry, weight, share, incoming));
    }
  }
  return sum;
}

double ApertureIntegrator::incident(const Aperture& source) const {
  const ArrayXd one = ArrayXd::Ones(1);
  constexpr double tolerance = 1e-16;
  return interface_flux([&](double) { return one; }, Region(source), incidence_range(source), one,
                        tolerance)
      .spectral(0);
}

Flux ApertureIntegrator::hemispherical(const Surface& surface, const Vector3& omega_i,
                                       const ArrayXd& weight, double tolerance) const {
  Surface lobes = surface;
  lobes.interfaces.clear();
  Flux sum{.spectral = surface.specular_reflectance(omega_i.z())};
  const auto faces = hemicube_faces();
  for (const Aperture& face : faces) {
    const Flux flux = reflected(lobes, {collimated(omega_i), face}, weight,
                                tolerance * omega_i.z() / double(faces.size()));
    sum.spectral += flux.spectral / omega_i.z();
    sum.error += flux.error / omega_i.z();
  }
  return sum;
}

}  // namespace gonio

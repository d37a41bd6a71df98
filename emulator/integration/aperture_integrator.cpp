#include "emulator/integration/aperture_integrator.hpp"

#include <algorithm>
#include <cmath>

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

/// Gauss points per cell and axis; more where more digits are asked for, which makes cells larger.
struct Orders {
  int source;
  int receptor;
};
Orders orders_for(double relative_tolerance) {
  return relative_tolerance > 1e-8 ? Orders{3, 5} : Orders{5, 8};
}

/// Breaks on both sides of `centre`, at distances that grow from `width`.
void add_graded(double centre, double width, double low, double high, std::vector<double>& breaks) {
  constexpr double first = 1.5;
  constexpr double growth = 4.0;
  if (!(width > 0.0 && width < high - low)) {
    return;
  }
  const double farthest = std::max(std::abs(centre - low), std::abs(centre - high));
  for (double distance = first * width; distance < farthest; distance *= growth) {
    for (const double x : {centre - distance, centre + distance}) {
      if (x > low && x < high) {
        breaks.push_back(x);
      }
    }
  }
}

struct Breaks {
  std::vector<double> p, q;

  /// Breaks round a point, in the coordinates of a region.
  void add(const Region& region, const PlanePoint& centre, double width_u, double width_v) {
    std::vector<double> us;
    const double u_low = region.row(region.p_low()).u;
    const double u_high = region.row(region.p_high()).u;
    add_graded(centre.u, width_u, u_low, u_high, us);
    for (const double u : us) {
      p.push_back(region.p_at(u));
    }
    const Region::Row row = region.row(region.p_at(std::clamp(centre.u, u_low, u_high)));
    const double half = 0.5 * (row.v_high - row.v_low);
    const Region::Row middle = region.row(0.5 * (region.p_low() + region.p_high()));
    const double scale = half > 0.0 ? half : 0.5 * (middle.v_high - middle.v_low);
    if (scale > 0.0) {
      add_graded((centre.v - 0.5 * (row.v_high + row.v_low)) / scale, width_v / scale, -1.0, 1.0,
                 q);
    }
  }
};

/// How far a lobe spreads round its peak in a tangent plane.
struct PlaneWidth {
  double u, v;
};
PlaneWidth plane_width(const SlopeWidth& slope, double cos_theta_d, const PlanePoint& peak) {
  const double stretch = 1.0 + peak.u * peak.u + peak.v * peak.v;
  return {2.0 * slope.x * stretch, 2.0 * slope.y * cos_theta_d * stretch};
}

/// What the differences of the rules make of a function at the nodes of a cell.
void set_errors(const CellNodes& nodes, const ArrayXd& control, CellEstimate& estimate) {
  const double best = (nodes.weight * control).sum();
  estimate.error_p = std::abs(best - (nodes.gauss_p * control).sum());
  estimate.error_q = std::abs(best - (nodes.gauss_q * control).sum());
}

/// Moments of one lobe over the receptor, for light from one direction: int g T_k cos r d omega_r.
class ReceptorIntegral {
 public:
  ReceptorIntegral(const Lobe& lobe, double parameter, const Aperture& receptor,
                   const ColourSeries& series, const VectorXd& functional, int order)
      : lobe_(lobe),
        parameter_(parameter),
        region_(receptor),
        series_(series),
        functional_(functional),
        order_(order) {}

  Integral operator()(const Vector3& omega_i, double tolerance) {
    const double cos_theta_i = omega_i.z();
    if (cos_theta_i <= 0.0) {
      return {.value = VectorXd::Zero(functional_.size())};
    }
    Breaks breaks;
    const SlopeWidth slope = lobe_.shape->slope_width(parameter_, cos_theta_i);
    if (const auto peak = project(region_.frame(), mirrored(omega_i))) {
      const PlaneWidth width = plane_width(slope, cos_theta_i, *peak);
      breaks.add(region_, *peak, width.u, width.v);
    }
    return integrate(
        region_, std::move(breaks.p), std::move(breaks.q),
        [&](const Cell& cell) { return estimate(omega_i, cell); }, tolerance, most_receptor_cells);
  }

 private:
  CellEstimate estimate(const Vector3& omega_i, const Cell& cell) {
    nodes_.place(region_, cell, order_, order_);
    const Index n = nodes_.u.size();
    omega_r_.resize(n);
    x_.resize(n);
    control_.resize(n);
    g_.resize(n);
    value_.setOnes(n);
    kernel::tangent_directions(region_.frame(), nodes_.u, nodes_.v, omega_r_, value_);
    lobe_.shape->evaluate(parameter_, omega_i, omega_r_, g_);
    kernel::half_angle_argument(omega_i, omega_r_, series_.scale, series_.shift, x_);
    kernel::chebyshev_series(functional_, x_, control_);
    value_ *= g_;
    control_ *= value_;
    CellEstimate result{.value = VectorXd::Zero(functional_.size())};
    set_errors(nodes_, control_, result);
    value_ *= nodes_.weight;
    kernel::add_chebyshev_moments(x_, value_, result.value);
    return result;
  }

  const Lobe& lobe_;
  double parameter_;
  Region region_;
  const ColourSeries& series_;
  const VectorXd& functional_;
  int order_;
  CellNodes nodes_;
  DirectionBatch omega_r_;
  ArrayXd x_, g_, value_, control_;
};

/// The same over the source too: int cos i d omega_i of the receptor's moments.
Integral lobe_moments(const Lobe& lobe, double parameter, const MeasuringGeometry& geometry,
                      const ColourSeries& series, const VectorXd& functional, double tolerance,
                      double incident) {
  const Index terms = functional.size();
  const Region source(geometry.source);
  const Orders orders = orders_for(tolerance / incident);
  ReceptorIntegral receptor(lobe, parameter, geometry.receptor, series, functional,
                            orders.receptor);
  Breaks breaks;
  const double cos_theta_i = geometry.source.frame().axis.z();
  const SlopeWidth slope = lobe.shape->slope_width(parameter, std::max(cos_theta_i, 0.0));
  const Aperture edge = geometry.receptor.mirrored();  // the lobe passes it within its own width
  for (const double side : {0.0, 1.0}) {
    const double u = std::lerp(edge.u_low(), edge.u_high(), side);
    const double v = std::lerp(edge.v_low(), edge.v_high(), side);
    for (const Vector3& omega : {edge.frame().direction(u, 0.0), edge.frame().direction(0.0, v)}) {
      if (const auto point = project(source.frame(), omega)) {
        const PlaneWidth width = plane_width(slope, std::abs(cos_theta_i), *point);
        breaks.add(source, *point, width.u, width.v);
      }
    }
  }
  const double inner_tolerance = 0.25 * tolerance / incident;
  const auto estimate = [&](const Cell& cell) {
    CellNodes nodes;
    nodes.place(source, cell, orders.source, orders.source);
    const Index n = nodes.u.size();
    DirectionBatch omega_i;
    omega_i.resize(n);
    ArrayXd factor = ArrayXd::Ones(n);
    kernel::tangent_directions(source.frame(), nodes.u, nodes.v, omega_i, factor);
    CellEstimate result{.value = VectorXd::Zero(terms + 1)};  // the last one is the inner error
    ArrayXd control(n);
    for (Index j = 0; j < n; ++j) {
      const Integral inner = receptor({omega_i.x(j), omega_i.y(j), omega_i.z(j)}, inner_tolerance);
      control(j) = factor(j) * functional.dot(inner.value);
      const double weight = nodes.weight(j) * factor(j);
      result.value.head(terms) += weight * inner.value;
      result.value(terms) += weight * inner.error;
    }
    set_errors(nodes, control, result);
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
  CellNodes nodes;
  const auto estimate = [&](const Cell& cell) {
    nodes.place(region, cell, order, order);
    const Index n = nodes.u.size();
    DirectionBatch omega;
    omega.resize(n);
    ArrayXd value = ArrayXd::Ones(n);
    kernel::tangent_directions(region.frame(), nodes.u, nodes.v, omega, value);
    const ArrayXd x = (series.scale * omega.z + series.shift).max(-1.0).min(1.0);
    ArrayXd control(n);
    kernel::chebyshev_series(functional, x, control);
    control *= value;
    CellEstimate result{.value = VectorXd::Zero(functional.size())};
    set_errors(nodes, control, result);
    value *= nodes.weight;
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
  return interface_flux([&](double) { return one; }, Region(source), incidence_range(source), one,
                        0.0)
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

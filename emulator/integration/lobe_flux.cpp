#include "emulator/integration/lobe_flux.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/panels.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// Where the integral of one lobe gives up: after about a second.
constexpr std::size_t most_cells = 1'000'000;

/// How far breaks go, in widths of the lobe: through its tails, or where the receptor's edge cuts
/// it.
constexpr double to_the_edge = 1e9;
constexpr double past_the_edge = 5.0;

/// Moments of one lobe over the receptor, for light from one direction: int g T_k cos r d omega_r.
///
/// The rows of a circle shrink towards its ends, and what is straight and lies along them bends in
/// their coordinates. So rows run along the lobe: a circle is turned so that p is across it.
class ReceptorIntegral {
 public:
  ReceptorIntegral(const Lobe& lobe, double parameter, const MeasuringGeometry& geometry,
                   const ColourSeries& series, const VectorXd& functional,
                   double relative_tolerance, std::size_t& budget)
      : lobe_(lobe),
        parameter_(parameter),
        is_turned_(geometry.receptor.outline() == Aperture::Outline::circle &&
                   width(geometry.source.frame().axis.z()).v <
                       width(geometry.source.frame().axis.z()).u),
        region_(is_turned_ ? geometry.receptor.turned() : geometry.receptor),
        series_(series),
        functional_(functional),
        budget_(budget),
        plan_(geometry.receptor, peak(geometry.source.frame().axis), relative_tolerance),
        rule_(region_, plan_.p.gauss_points, plan_.q.gauss_points) {}

  Integral operator()(const Vector3& omega_i, double tolerance) {
    if (omega_i.z() <= 0.0) {
      return {.value = VectorXd::Zero(functional_.size())};
    }
    Breaks breaks;
    if (const auto at = peak(omega_i)) {
      breaks.add_u(region_, *at, plan_.p, to_the_edge);
      breaks.add_v(region_, *at, plan_.q, to_the_edge);
    }
    return integrate(
        region_, std::move(breaks.p), std::move(breaks.q),
        [&](const Cell& cell) { return estimate(omega_i, cell); }, tolerance, budget_);
  }

 private:
  [[nodiscard]] LobeWidth width(double cos_theta_i) const {
    return LobeWidth(lobe_.shape->slope_width(parameter_, cos_theta_i), cos_theta_i);
  }
  [[nodiscard]] std::optional<Peak> peak(const Vector3& omega_i) const {
    const LobeWidth along = width(omega_i.z());
    return peak_in(region_.frame(), mirrored(omega_i), is_turned_ ? along.turned() : along);
  }

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
  bool is_turned_;  // the circle's u and v
  Region region_;
  const ColourSeries& series_;
  const VectorXd& functional_;
  std::size_t& budget_;
  Plan plan_;
  SquareRule rule_;
  CellNodes nodes_;
  DirectionBatch omega_r_;
  ArrayXd x_, g_, control_;
};

/// The receptor's moments over the source: int cos i d omega_i. The value is followed by the error
/// of the receptor's integrals.
class SourceIntegral {
 public:
  /// @param is_symmetric  both apertures are: light from both sides of the plane of measurement is
  ///                      reflected alike, and cells at q < 0 are those at q > 0.
  SourceIntegral(ReceptorIntegral& receptor, const Aperture& source, const Plan& plan,
                 const VectorXd& functional, bool is_symmetric)
      : receptor_(receptor),
        region_(source),
        rule_(region_, plan.p.gauss_points, plan.q.gauss_points),
        functional_(functional),
        is_symmetric_(is_symmetric) {}

  [[nodiscard]] const Region& region() const { return region_; }

  /// @param tolerance  of the receptor's integrals.
  CellEstimate operator()(const Cell& cell, double tolerance) {
    const Index terms = functional_.size();
    CellEstimate result{.value = VectorXd::Zero(terms + 1)};
    if (is_symmetric_ && cell.q_high <= 0.0) {
      return result;
    }
    nodes_.place(region_, cell, rule_);
    const Index n = rule_.size();
    omega_i_.resize(n);
    ArrayXd& factor = nodes_.area;  // becomes cos i d omega_i, but for the weights of the rule
    kernel::tangent_directions(region_.frame(), nodes_.u, nodes_.v, omega_i_, factor);
    factor *= is_symmetric_ && cell.q_low >= 0.0 ? 2.0 : 1.0;
    const bool is_mirrored = is_symmetric_ && cell.q_low == -cell.q_high;
    std::vector<Integral> inner(std::size_t(n), Integral{});
    ArrayXd control = ArrayXd::Zero(n);
    for (Index j = 0; j < n; ++j) {
      if (rule_.weight(j) == 0.0) {
        continue;
      }
      const Index opposite = is_mirrored ? rule_.opposite_in_q(j) : j;
      Integral& at_node = inner[std::size_t(j)];
      at_node = opposite < j ? inner[std::size_t(opposite)]
                             : receptor_({omega_i_.x(j), omega_i_.y(j), omega_i_.z(j)}, tolerance);
      control(j) = factor(j) * functional_.dot(at_node.value);
      const double weight = rule_.weight(j) * factor(j);
      result.value.head(terms) += weight * at_node.value;
      result.value(terms) += weight * at_node.error;
    }
    result.set_errors(rule_, control);
    return result;
  }

 private:
  ReceptorIntegral& receptor_;
  Region region_;
  SquareRule rule_;
  const VectorXd& functional_;
  bool is_symmetric_;
  CellNodes nodes_;
  DirectionBatch omega_i_;
};

/// Breaks over the source where the receptor's edges cut the lobe.
Breaks breaks_at_edges(const Region& source, const std::vector<Peak>& edges, const Plan& plan) {
  Breaks breaks;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i < 2) {
      breaks.add_u(source, edges[i], plan.p, past_the_edge);
    } else {
      breaks.add_v(source, edges[i], plan.q, past_the_edge);
    }
  }
  return breaks;
}

}  // namespace

LobeFlux::LobeFlux(const Lobe& lobe, const MeasuringGeometry& geometry, const ArrayXd& weight,
                   double tolerance, double incident)
    : lobe_(lobe),
      geometry_(geometry),
      weight_(weight),
      tolerance_(tolerance),
      incident_(incident),
      series_(lobe.colour, half_angle_range(geometry).low, half_angle_range(geometry).high,
              0.02 * tolerance / incident),
      functional_(series_.coefficient * weight.matrix()) {}

Flux LobeFlux::operator()() const {
  return lobe_.shape_parameter.size() == 0 ? with_fixed_shape(0.0) : with_changing_shape();
}

/// Moments over both apertures.
Integral LobeFlux::moments(double parameter, double tolerance) const {
  constexpr double planned = 0.2;        // of the tolerance: cells count their errors fivefold
  constexpr double for_receptor = 0.25;  // of the tolerance; the rest is for the source
  const double relative = std::clamp(planned * tolerance / incident_, 1e-15, 1e-3);
  const double cos_theta_i = geometry_.source.frame().axis.z();
  std::size_t budget = most_cells;
  ReceptorIntegral receptor(lobe_, parameter, geometry_, series_, functional_, relative, budget);
  const auto edges = receptor_edges(
      geometry_, LobeWidth(lobe_.shape->slope_width(parameter, cos_theta_i), cos_theta_i));
  const Plan plan(geometry_.source, scale_over_source(geometry_.source, edges), relative);
  const bool is_symmetric = geometry_.source.is_symmetric() && geometry_.receptor.is_symmetric();
  SourceIntegral source(receptor, geometry_.source, plan, functional_, is_symmetric);
  Breaks breaks = breaks_at_edges(source.region(), edges, plan);
  if (is_symmetric) {
    breaks.make_q_symmetric();
  }
  Integral sum = integrate(
      source.region(), std::move(breaks.p), std::move(breaks.q),
      [&](const Cell& cell) { return source(cell, for_receptor * tolerance / incident_); },
      (1.0 - for_receptor) * tolerance, budget);
  const Index terms = functional_.size();
  sum.error += sum.value(terms);
  sum.value.conservativeResize(terms);
  return sum;
}

Flux LobeFlux::with_fixed_shape(double parameter) const {
  const Integral sum = moments(parameter, tolerance_);
  return {.spectral = (series_.coefficient.transpose() * sum.value).array(),
          .error = sum.error + std::abs(sum.value(0)) * series_.truncation.maxCoeff()};
}

/// Points of the parameter are doubled until the flux settles.
Flux LobeFlux::with_changing_shape() const {
  constexpr Index most_points = 65;
  const double low = lobe_.shape_parameter.minCoeff();
  const double high = lobe_.shape_parameter.maxCoeff();
  const double node_tolerance = 0.3 * tolerance_;  // interpolation amplifies by less than 2
  if (high - low <= 1e-12 * high) {
    return with_fixed_shape(low);
  }
  const ArrayXd x = (2.0 * lobe_.shape_parameter - (low + high)) / (high - low);
  std::vector<Integral> at_point;
  Flux before;
  for (Index n = 3;; n = 2 * n - 1) {
    const ArrayXd point = chebyshev_points(n);
    std::vector<Integral> now;
    Eigen::MatrixXd at_points(functional_.size(), n);
    double error = 0.0;
    for (Index j = 0; j < n; ++j) {  // every second point is one of the n before
      const double parameter = 0.5 * ((high + low) + (high - low) * point(j));
      now.push_back(!at_point.empty() && j % 2 == 0 ? at_point[std::size_t(j / 2)]
                                                    : moments(parameter, node_tolerance));
      at_points.col(j) = now.back().value;
      error = std::max(error, 2.0 * now.back().error);
    }
    at_point = std::move(now);
    const Eigen::MatrixXd at_lambda = at_points * chebyshev_interpolation(n, x).transpose();
    Flux flux{
        .spectral = series_.coefficient.cwiseProduct(at_lambda).colwise().sum().transpose(),
        .error = error + at_lambda.row(0).cwiseAbs().maxCoeff() * series_.truncation.maxCoeff()};
    if (n > 3) {
      const double change = (weight_ * (flux.spectral - before.spectral).abs()).sum();
      flux.error += change;
      if (change <= 0.3 * tolerance_ || n >= most_points) {
        return flux;
      }
    }
    before = flux;
  }
}

}  // namespace gonio

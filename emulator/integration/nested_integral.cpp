#include "emulator/integration/nested_integral.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/integration/batch_kernels.hpp"
#include "emulator/integration/panels.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// How far breaks go, in widths of the lobe: through its tails, or where the receptor's edge cuts
/// it.
constexpr double to_the_edge = 1e9;
constexpr double past_the_edge = 5.0;

/// The integrals over the receptor, for light from one direction: int f_k cos r d omega_r.
///
/// The rows of a circle shrink towards its ends, and what is straight and lies along them bends in
/// their coordinates. So rows run along the lobe: a circle is turned so that p is across it.
class ReceptorIntegral {
 public:
  ReceptorIntegral(Integrand& integrand, const MeasuringGeometry& geometry,
                   double relative_tolerance, std::size_t& budget)
      : integrand_(integrand),
        is_turned_(geometry.receptor.outline() == Aperture::Outline::circle &&
                   width(geometry.source.frame().axis.z()).v <
                       width(geometry.source.frame().axis.z()).u),
        region_(is_turned_ ? geometry.receptor.turned() : geometry.receptor),
        budget_(budget),
        plan_(geometry.receptor, peak(geometry.source.frame().axis), relative_tolerance),
        rule_(region_, plan_.p.gauss_points, plan_.q.gauss_points) {}

  Integral operator()(const Vector3& omega_i, double tolerance) {
    if (omega_i.z() <= 0.0) {
      return {.value = VectorXd::Zero(integrand_.functional().size())};
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
    return LobeWidth(integrand_.slope_width(cos_theta_i), cos_theta_i);
  }
  [[nodiscard]] std::optional<Peak> peak(const Vector3& omega_i) const {
    const LobeWidth along = width(omega_i.z());
    return peak_in(region_.frame(), mirrored(omega_i), is_turned_ ? along.turned() : along);
  }

  CellEstimate estimate(const Vector3& omega_i, const Cell& cell) {
    nodes_.place(region_, cell, rule_);
    omega_r_.resize(rule_.size());
    ArrayXd& value = nodes_.area;  // becomes cos r d omega_r, but for the weights of the rule
    kernel::tangent_directions(region_.frame(), nodes_.u, nodes_.v, omega_r_, value);
    integrand_.evaluate(omega_i, omega_r_);
    integrand_.control(control_);
    control_ *= value;
    CellEstimate result{.value = VectorXd::Zero(integrand_.functional().size())};
    result.set_errors(rule_, control_);
    value *= rule_.weight;
    integrand_.add(value, result.value);
    return result;
  }

  Integrand& integrand_;
  bool is_turned_;  // the circle's u and v
  Region region_;
  std::size_t& budget_;
  Plan plan_;
  SquareRule rule_;
  CellNodes nodes_;
  DirectionBatch omega_r_;
  ArrayXd control_;
};

/// The receptor's integrals over the source: int cos i d omega_i. The value is followed by the
/// error of the receptor's integrals.
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

Integral nested_integral(Integrand& integrand, const MeasuringGeometry& geometry, double tolerance,
                         double incident, std::size_t& budget) {
  constexpr double planned = 0.2;        // of the tolerance: cells count their errors fivefold
  constexpr double for_receptor = 0.25;  // of the tolerance; the rest is for the source
  const double relative = std::clamp(planned * tolerance / incident, 1e-15, 1e-3);
  const double cos_theta_i = geometry.source.frame().axis.z();
  ReceptorIntegral receptor(integrand, geometry, relative, budget);
  const auto edges =
      receptor_edges(geometry, LobeWidth(integrand.slope_width(cos_theta_i), cos_theta_i));
  const Plan plan(geometry.source, scale_over_source(geometry.source, edges), relative);
  const bool is_symmetric = integrand.is_symmetric() && geometry.source.is_symmetric() &&
                            geometry.receptor.is_symmetric();
  SourceIntegral source(receptor, geometry.source, plan, integrand.functional(), is_symmetric);
  Breaks breaks = breaks_at_edges(source.region(), edges, plan);
  if (is_symmetric) {
    breaks.make_q_symmetric();
  }
  Integral sum = integrate(
      source.region(), std::move(breaks.p), std::move(breaks.q),
      [&](const Cell& cell) { return source(cell, for_receptor * tolerance / incident); },
      (1.0 - for_receptor) * tolerance, budget);
  const Index terms = integrand.functional().size();
  sum.error += sum.value(terms);
  sum.value.conservativeResize(terms);
  return sum;
}

}  // namespace gonio

#include "emulator/procedure/measurement_equation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <unsupported/Eigen/AutoDiff>

namespace gonio {

MeasurementEquation::Gradient MeasurementEquation::gradient(double g,
                                                            const Components<double>& d) const {
  constexpr int n = int(uncertainty_component_count);
  using Derivatives = Eigen::Matrix<double, n + 1, 1>;
  using Number = Eigen::AutoDiffScalar<Derivatives>;
  Components<Number> components;
  for (int i = 0; i < n; ++i) {
    components[std::size_t(i)] = Number(d[std::size_t(i)], n + 1, i);
  }
  const Number found = reading(Number(g, n + 1, n), components);
  Gradient result{.reading = found.value(), .by_optics = found.derivatives()(n)};
  Eigen::Map<Eigen::VectorXd>(result.by_component.data(), n) = found.derivatives().head<n>();
  return result;
}

MeasurementEquation measurement_equation(const Instrument& instrument,
                                         const std::string& geometry_id) {
  const Behaviour& b = instrument.behaviour;
  const auto channel =
      std::ranges::find(instrument.geometries, geometry_id) - instrument.geometries.begin();
  return {.scale = instrument.standard.scale,
          .theta_i = instrument.standard.geometry(geometry_id).theta_i.nominal,
          .full_scale_gu = b.full_scale_gu.empty() ? 0.0 : b.full_scale_gu.at(std::size_t(channel)),
          .signal_per_k = b.signal_per_k,
          .tile_contamination = b.tile_contamination};
}

}  // namespace gonio

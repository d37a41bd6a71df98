#include "emulator/quality/reading_places.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "emulator/surface/spot.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// M of M M^T = covariance, which may be singular.
MatrixXd square_root(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

std::vector<PanelPlace> all_positions(const SamplingPlan& plan) {
  std::vector<PanelPlace> all = plan.positions;
  all.insert(all.end(), plan.further_positions.begin(), plan.further_positions.end());
  return all;
}

/// How the film at spots goes together: two for each position, of the same geometries in order.
MatrixXd field_covariance(const std::vector<Spot>& spots, std::size_t per_position,
                          const std::optional<double>& correlation_length_mm) {
  const auto n = Index(spots.size());
  MatrixXd covariance(n, n);
  for (Index a = 0; a < n; ++a) {
    for (Index b = 0; b <= a; ++b) {
      const bool same_position = a / Index(per_position) == b / Index(per_position);
      covariance(a, b) = correlation_length_mm
                             ? spot_correlation(spots[std::size_t(a)], spots[std::size_t(b)],
                                                *correlation_length_mm)
                             : (same_position ? 1.0 : 0.0);
      covariance(b, a) = covariance(a, b);
    }
  }
  return covariance;
}

std::vector<SpotShare> shares_of_spot(const SampleFamily& family, const Spot& spot) {
  const PanelLayout* layout = family.layout();
  return layout == nullptr ? std::vector{SpotShare{.weight = 1.0}} : shares(*layout, spot);
}

/// What hangs over the edge of a panel reads what lies beside it.
void expect_on_panel(const Batch& batch, const Instrument& instrument, const std::string& geometry,
                     const Spot& spot) {
  const PanelLayout panel{.length_mm = batch.product->panel_length_mm,
                          .width_mm = batch.product->panel_width_mm};
  if (!panel.carries(spot)) {
    throw InputError(
        {.file = batch.file.string(), .key = "sampling"},
        fmt::format("positions where the spot of {} at {} deg, {:.3g} mm by {:.3g} mm, lies on the "
                    "panel of {:g} mm by {:g} mm",
                    instrument.id, geometry, 2.0 * spot.half_length_mm, 2.0 * spot.half_width_mm,
                    panel.length_mm, panel.width_mm),
        fmt::format("{:g} mm, {:g} mm", spot.x_mm, spot.y_mm));
  }
}

}  // namespace

ReadingPlaces reading_places(const Batch& batch, const Instrument& instrument,
                             const std::vector<std::uint32_t>& channels,
                             const SampleFamily& family) {
  ReadingPlaces places;
  std::vector<Spot> spots;
  for (const PanelPlace& position : all_positions(batch.plan)) {
    for (const std::uint32_t channel : channels) {
      const std::string& geometry = batch.channels[channel].geometry;
      spots.push_back(instrument.spot(geometry, position.x_mm, position.y_mm));
      expect_on_panel(batch, instrument, geometry, spots.back());
      places.shares.push_back(shares_of_spot(family, spots.back()));
    }
  }
  places.film =
      square_root(field_covariance(spots, channels.size(), batch.product->correlation_length_mm));
  return places;
}

std::vector<SpotShare> shares_of_panel(const SampleFamily& family) {
  const PanelLayout* layout = family.layout();
  return layout == nullptr ? std::vector{SpotShare{.weight = 1.0}} : shares(*layout);
}

}  // namespace gonio

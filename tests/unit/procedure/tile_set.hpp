#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "emulator/procedure/setup_estimator.hpp"
#include "tests/unit/procedure/responses.hpp"

namespace gonio::test {

inline Instrument triangle_gloss() { return shipped_instrument("triangle_gloss"); }

/// A sample of the ladder, or a shipped one.
inline Sample tile(const std::string& id, Angle tilt = {}) {
  static const std::vector<Sample> ladder = effect_ladder(few_wavelengths);
  const auto found = std::ranges::find(ladder, id, &Sample::id);
  Sample sample = found != ladder.end()
                      ? *found
                      : load_sample(shipped().find(Catalog::Kind::sample, id), few_wavelengths);
  sample.tilt = tilt;
  return sample;
}

/// Matt to mirror, with tiles on wedges of both directions, which tell theta_r from theta_i, and
/// brush marks, which tell the sides of an opening apart.
inline std::vector<Sample> useful_tiles() {
  return {tile("paint_m300"),
          tile("glass_m100"),
          tile("copper_m065"),
          tile("glass_m030"),
          tile("glass_m020", degrees(0.5)),
          tile("glass_m050", degrees(-1.0)),
          tile("glass_m050"),
          tile("black_glass_paper"),
          tile("clearcoat_hazy"),
          tile("paint_smooth"),
          tile("steel_brushed")};
}

/// Those that are computed fast, so that the trials are.
inline std::vector<Sample> quick_tiles(const std::string& geometry) {
  std::vector<Sample> tiles{tile("paint_m300"), tile("glass_m100"), tile("paint_smooth"),
                            tile("steel_brushed")};
  if (geometry == "85") {  // narrow lobes take long there
    tiles.push_back(tile("aluminium_m200", degrees(1.0)));
  } else {
    tiles.push_back(tile("aluminium_m200"));
    tiles.push_back(tile("glass_m050", degrees(-0.5)));
  }
  return tiles;
}

/// Tiles, and how a set-up reads them.
class TileSet {
 public:
  /// @param expanded_uncertainty_gu  of each reading
  TileSet(const std::string& geometry, std::vector<Sample> tiles, double expanded_uncertainty_gu,
          const SetupEstimateOptions& options)
      : tiles_(std::move(tiles)),
        estimator_(triangle_gloss(), geometry, tiles_, options),
        expanded_uncertainty_gu_(expanded_uncertainty_gu) {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      readings_.push_back({.sample = tiles_[i].id,
                           .geometry = geometry,
                           .expanded_uncertainty_gu = expanded_uncertainty_gu});
      tile_of_.push_back(i);
    }
  }
  TileSet(const TileSet&) = delete;
  TileSet& operator=(const TileSet&) = delete;

  [[nodiscard]] const SetupEstimator& estimator() const { return estimator_; }
  [[nodiscard]] double u_gu() const { return 0.5 * expanded_uncertainty_gu_; }
  [[nodiscard]] Eigen::Index size() const { return Eigen::Index(tiles_.size()); }
  [[nodiscard]] Eigen::Index parameters() const {
    return Eigen::Index(estimator_.parameters().size());
  }

  /// Parameters that deviate from what was assumed by t times their prior uncertainties.
  [[nodiscard]] Eigen::VectorXd setup(const Eigen::VectorXd& t) const {
    Eigen::VectorXd x(t.size());
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const EstimatedParameter& parameter = estimator_.parameters()[std::size_t(i)];
      x(i) = parameter.assumed + t(i) * parameter.prior_uncertainty;
    }
    return x;
  }
  [[nodiscard]] Eigen::VectorXd as_assumed() const {
    return setup(Eigen::VectorXd::Zero(parameters()));
  }

  /// @param gloss_gu  of each tile
  [[nodiscard]] SetupEstimate estimate(const Eigen::VectorXd& gloss_gu) const {
    std::vector<TileReading> readings = readings_;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      readings[i].gloss_gu = gloss_gu(Eigen::Index(i));
    }
    return estimator_.estimate(readings, tile_of_);
  }
  /// Of readings without noise of that set-up.
  [[nodiscard]] SetupEstimate estimate_of(const Eigen::VectorXd& x) const {
    return estimate(estimator_.reading(x));
  }

 private:
  std::vector<Sample> tiles_;
  SetupEstimator estimator_;
  double expanded_uncertainty_gu_;
  std::vector<TileReading> readings_ = {};
  std::vector<std::size_t> tile_of_ = {};
};

inline const EstimatedParameter& parameter(const SetupEstimate& estimate, const std::string& name) {
  return *std::ranges::find(estimate.parameters, name, &EstimatedParameter::name);
}
/// Of the triangle's geometries: theta_i 0, theta_r 1, source 2 and 3, receptor 4 and 5, then
/// reference_value 6 and zero 7.
inline std::size_t place(const SetupEstimate& estimate, const std::string& name) {
  return std::size_t(&parameter(estimate, name) - estimate.parameters.data());
}

}  // namespace gonio::test

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "emulator/measured/brdf_points.hpp"

namespace gonio {

/// The BRDF of one incidence, on a grid of directions of reflection.
class BrdfSlice {
 public:
  /// What of the grid was not as it should be.
  struct Report {
    Eigen::Index holes = 0, doubled = 0;
  };

  /// Nothing if less than half of the grid of their polar angles and azimuths is there. Holes, as
  /// where the receptor would stand before the source, get what is next to them.
  /// @param rows  of the points of this incidence.
  [[nodiscard]] static std::optional<BrdfSlice> on_grid(const BrdfPoints& points,
                                                        const std::vector<Eigen::Index>& rows,
                                                        Report& report);

  /// Adds what is seen in a direction, in the plane of incidence, as f_r^(1/4) times a weight.
  void add(const Vector3& local, double weight, Eigen::Ref<Eigen::ArrayXd> root) const;
  /// The angle between directions about (theta, mirror azimuth) [rad].
  [[nodiscard]] double step(double theta) const;
  [[nodiscard]] double largest_theta() const { return theta_[theta_.size() - 1]; }

 private:
  BrdfSlice() = default;
  [[nodiscard]] Eigen::Index cell(Eigen::Index i_theta, Eigen::Index i_azimuth) const {
    return i_theta * azimuth_.size() + i_azimuth;
  }
  void fill_holes(const std::vector<int>& counts);
  [[nodiscard]] Vector3 direction_of(Eigen::Index i_theta, Eigen::Index i_azimuth) const;

  Eigen::ArrayXd theta_, azimuth_;  ///< azimuths in [0, 2 pi), or in [0, pi] if mirrored
  bool is_mirrored_ = false;
  Eigen::ArrayXXd root_;  ///< f_r^(1/4), shape (n_channels, cells): one cell is one column
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// A BRDF on a grid about the mirror direction, as ray tracers keep it: the angle to that direction
/// (radial), and the azimuth round it, 0 towards the normal. f_r is linear in all angles, so that
/// the lobe moves with the incidence.
class SpecularTable : public MeasuredBrdf {
 public:
  /// Angles [rad], each ascending.
  struct Grid {
    Eigen::ArrayXd rotation;  ///< of the incident azimuth from pi, in [0, 2 pi); one: isotropic
    Eigen::ArrayXd theta_i;   ///< in [0, pi/2]
    Eigen::ArrayXd azimuth;   ///< in [0, 2 pi]; if none is beyond pi, the other side mirrors this
    Eigen::ArrayXd radial;    ///< in [0, pi]

    [[nodiscard]] Eigen::Index size() const {
      return rotation.size() * theta_i.size() * azimuth.size() * radial.size();
    }
    /// Of a node in f_r.
    [[nodiscard]] Eigen::Index row(Eigen::Index i_rotation, Eigen::Index i_theta_i,
                                   Eigen::Index i_azimuth, Eigen::Index i_radial) const {
      return ((i_rotation * theta_i.size() + i_theta_i) * azimuth.size() + i_azimuth) *
                 radial.size() +
             i_radial;
    }
    /// cos theta_r of a node; negative below the surface.
    [[nodiscard]] double cos_theta_r(Eigen::Index i_theta_i, Eigen::Index i_azimuth,
                                     Eigen::Index i_radial) const;
  };

  /// @param f_r  [1/sr], shape (grid.size(), n_channels), the radial angle running fastest. What is
  ///             below the surface counts for nothing.
  /// @throws std::invalid_argument  if shapes do not agree, or angles do not ascend in their range.
  SpecularTable(std::vector<BrdfChannel> channels, Grid grid, Eigen::ArrayXXd f_r);

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  [[nodiscard]] const Grid& grid() const { return grid_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override;
  [[nodiscard]] Angle step(Angle theta_i) const override;
  [[nodiscard]] Angle largest_theta() const override;

 private:
  void continue_below_surface();

  std::vector<BrdfChannel> channels_;
  Grid grid_;
  Eigen::ArrayXXd root_;  ///< f_r^(1/4)
  bool is_mirrored_ = false;
};

}  // namespace gonio

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator/measured/brdf_samples.hpp"
#include "emulator/optics/direction.hpp"

namespace gonio {

/// Angles of samples [rad] nearer than this are one: files have few digits.
inline constexpr double same_angle = 1e-4;

/// Samples with angles from the plane of incidence, polar ones not negative.
struct BrdfPoints {
  Eigen::ArrayXd theta_i;
  Eigen::ArrayXd rotation;  ///< of the incident azimuth from pi, in [0, 2 pi)
  Eigen::ArrayXd theta_r;
  Eigen::ArrayXd azimuth;    ///< from the mirror direction, in (-pi, pi]; not negative if mirrored
  Eigen::ArrayXXd f_r;       ///< not negative
  bool is_mirrored = false;  ///< all were on one side of the plane of incidence
  bool is_isotropic = true;  ///< one rotation, or none but along the normal

  [[nodiscard]] Eigen::Index size() const { return theta_i.size(); }
  /// Whether the plane of incidence holds all points.
  [[nodiscard]] bool is_in_plane() const;
};

/// @param channel_order  columns of f_r, as they are to stand.
[[nodiscard]] BrdfPoints brdf_points(const BrdfSamples& samples,
                                     const std::vector<Eigen::Index>& channel_order,
                                     std::vector<std::string>& warnings);

/// Values in ascending order, those within same_angle of one another once.
[[nodiscard]] Eigen::ArrayXd distinct_angles(std::vector<double> values);
/// The place of a value in what distinct_angles gave.
[[nodiscard]] Eigen::Index index_of_angle(const Eigen::ArrayXd& distinct, double value);

}  // namespace gonio

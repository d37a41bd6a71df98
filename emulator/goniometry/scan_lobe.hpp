#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "emulator/goniometry/scan.hpp"

namespace gonio {

/// What a scan shows of the light from one angle of incidence, with the sample turned one way.
struct ScanLobe {
  Angle theta_i, rotation;
  std::vector<Eigen::Index> positions = {};  ///< in the order of the scan
  Eigen::Index peak = 0;                     ///< the position of the largest weighted f_r
  Angle from_mirror = {};  ///< between the receptor at the peak and the mirror direction
  /// Reflectance into the hemisphere as the scan adds it up, shape (n_lambda); nothing where the
  /// receptor does not go all round: see hemisphere_weights.
  std::optional<Eigen::ArrayXd> hemispherical = {};
};

/// What each position counts in a sum over the hemisphere [sr], of sum pi,
///
///   w = (sin^2 theta_high - sin^2 theta_low) / 2 * (phi_high - phi_low),
///
/// with the bounds half way to the neighbours. A half circle of azimuths is enough for an isotropic
/// sample.
/// @return  shape (positions.size()); nothing unless polar angles are not negative, some of them is
///          80 deg or more, and azimuths are at most 45 deg apart.
[[nodiscard]] std::optional<Eigen::ArrayXd> hemisphere_weights(
    const std::vector<ScanPosition>& positions, bool is_isotropic);

/// The lobes of a scan, in its order; none of those that are blocked altogether. Of blocked
/// positions a sum takes the mean of their neighbours in polar angle.
[[nodiscard]] std::vector<ScanLobe> scan_lobes(const ScanResult& result);

}  // namespace gonio

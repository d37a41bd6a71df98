#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// A BRDF at directions one by one, as a goniometer records it.
struct BrdfSamples {
  /// What is said of the measurement, by the keys of ASTM E1392 where it has them (SAMPLE_NAME,
  /// SYSTEM_NAME, MEAS_DATE ...); in the order of keys.
  std::map<std::string, std::string> notes = {};
  std::vector<BrdfChannel> channels = {};
  /// Polar angles and azimuths [rad] of incidence and reflection, shape (n): azimuths as in
  /// direction.hpp, so that light from azimuth pi is mirrored to azimuth 0.
  Eigen::ArrayXd theta_i = {}, phi_i = {}, theta_r = {}, phi_r = {};
  Eigen::ArrayXXd f_r = {};  ///< [1/sr], shape (n, n_channels)

  [[nodiscard]] Eigen::Index size() const { return theta_i.size(); }
};

}  // namespace gonio

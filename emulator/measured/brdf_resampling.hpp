#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "emulator/measured/brdf_samples.hpp"
#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// Directions at which a BRDF is to be sampled.
struct BrdfSampling {
  /// Polar angles of incidence; empty: every 5 deg up to where it was measured.
  std::vector<Angle> theta_i = {};
  /// Azimuths of incidence from pi; one: one side of the plane of incidence, else both.
  std::vector<Angle> rotation = {Angle()};
  /// Of the polar angle and azimuth of reflection; finer about the mirror direction, down to the
  /// step of the BRDF, and to a quarter of theta_step in any case.
  Angle theta_step = degrees(2.5), azimuth_step = degrees(7.5);
};

inline constexpr Eigen::Index most_brdf_samples = 2'000'000;

/// A BRDF at a grid of directions for each incidence.
/// @throws std::invalid_argument  if they would be more than most_brdf_samples.
[[nodiscard]] BrdfSamples sample_brdf(const MeasuredBrdf& brdf, const BrdfSampling& sampling);

/// How channels are made of others, shape (n_from, n_to): each of itself; Luminance of Y, or of R,
/// G and B by IEC 61966-2-1.
/// @throws std::invalid_argument  for one that cannot be made, with its name.
[[nodiscard]] Eigen::MatrixXd channel_conversion(const std::vector<BrdfChannel>& from,
                                                 const std::vector<BrdfChannel>& to);

/// A BRDF with other channels. @throws std::invalid_argument  as above.
[[nodiscard]] std::shared_ptr<const MeasuredBrdf> with_channels(
    std::shared_ptr<const MeasuredBrdf> brdf, std::vector<BrdfChannel> channels);

}  // namespace gonio

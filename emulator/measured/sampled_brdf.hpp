#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/measured/brdf_samples.hpp"
#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// A BRDF between the directions of a goniometer.
///
/// Directions of reflection that were measured for one incidence are mostly a grid of polar angles
/// and azimuths, each incidence with its own. Between two incidences the lobe moves: what one half
/// vector shows at either is taken together, so that a mirror direction stays one. Where one side
/// only of the plane of incidence was measured the other mirrors it; where that plane alone was,
/// azimuths about the mirror direction are filled in. What lies on no grid is weighted by the
/// inverse square of its distance.
///
/// Between nodes the fourth root of f_r is linear: lobes fall steeply from their maximum, and taken
/// as linear they would reflect up to twice of what they do. Unlike a logarithm, the root exists at
/// 0.
class SampledBrdf : public MeasuredBrdf {
 public:
  /// @param samples   at least one, all finite; of negative f_r, 0 is made.
  /// @param warnings  gets what was made the best of.
  /// @throws std::invalid_argument  if there is no sample, or shapes do not agree.
  SampledBrdf(const BrdfSamples& samples, std::vector<std::string>& warnings);

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override;
  [[nodiscard]] Angle step(Angle theta_i) const override;
  [[nodiscard]] Angle largest_theta() const override { return largest_theta_; }

 private:
  std::vector<BrdfChannel> channels_;
  std::unique_ptr<const MeasuredBrdf> interpolation_;
  Angle largest_theta_;
};

}  // namespace gonio

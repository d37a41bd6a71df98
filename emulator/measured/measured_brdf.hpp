#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/measured/brdf_channel.hpp"
#include "emulator/optics/direction.hpp"

namespace gonio {

/// A BRDF as it was measured: numbers at directions, and a way between them.
///
/// Directions are in the frame of the sample. Most samples were measured as isotropic ones: then
/// only the difference of azimuths counts.
class MeasuredBrdf {
 public:
  virtual ~MeasuredBrdf() = default;

  /// One kind of band, or ascending wavelengths.
  [[nodiscard]] virtual const std::vector<BrdfChannel>& channels() const = 0;

  /// f_r [1/sr]; not negative; 0 where a direction is not above the surface. May be called from
  /// several threads.
  /// @param omega_i  unit.   @param omega_r  unit, shape (n).
  /// @param f_r      result, shape (n, n_channels).
  virtual void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                        Eigen::Ref<Eigen::ArrayXXd> f_r) const = 0;

  /// How finely it was measured round the mirror direction of light from there: the angle between
  /// neighbouring directions omega_r. What is narrower, it cannot show.
  [[nodiscard]] virtual Angle step(Angle theta_i) const = 0;

  /// Polar angles beyond this were not measured, and are guesses.
  [[nodiscard]] virtual Angle largest_theta() const = 0;
};

}  // namespace gonio

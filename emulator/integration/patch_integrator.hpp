#pragma once

#include "emulator/integration/flux.hpp"

namespace gonio {

/// The method of the paper: the hemisphere is cut into patches, a patch belongs to an aperture when
/// its centre does, and eq. (16) and (17) are sums over patches.
///
/// The patches are those of a hemicube, N x N on the top face and N x N / 2 on each of four sides
/// in equal steps: 3 N^2 in all, 196,608 at N = 256, of solid angle area / r^3. The paper does not
/// say its layout; this one has its number. Receptor edges cut patches, so that gloss errs by
/// percents at that number; reflectance into the whole hemisphere is good to 1e-7.
///
/// The error reported is the difference to half the resolution, or what the solid angle of the
/// receptor's patches is off from its own, whichever is larger: an estimate, not a bound. It is
/// relative to what the source's patches bring, since a gloss value is a ratio of fluxes from the
/// same ones.
/// @see [Mihalik] section 5, eq. (16), (17)
class PatchIntegrator : public FluxIntegrator {
 public:
  /// @param resolution  N, a multiple of 4.
  /// @throws std::domain_error  if it is not.
  explicit PatchIntegrator(Eigen::Index resolution = 256);

  [[nodiscard]] Flux reflected(const Surface& surface, const MeasuringGeometry& geometry,
                               const Eigen::ArrayXd& weight, double tolerance) const override;
  [[nodiscard]] double incident(const Aperture& source) const override;
  [[nodiscard]] Flux hemispherical(const Surface& surface, const Vector3& omega_i,
                                   const Eigen::ArrayXd& weight, double tolerance) const override;

  /// Number of patches on the hemisphere, 3 N^2.
  [[nodiscard]] Eigen::Index patch_count() const { return 3 * resolution_ * resolution_; }

 private:
  Eigen::Index resolution_;
};

}  // namespace gonio

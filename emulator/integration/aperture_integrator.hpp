#pragma once

#include "emulator/integration/flux.hpp"

namespace gonio {

/// Integrates over the apertures themselves: Gauss-Kronrod rules in their tangent planes, on panels
/// graded round the mirror direction and halved where the rules disagree. Smooth interfaces are
/// integrated over the overlap of the source image with the receptor. The reported error is the sum
/// over all panels of the difference between the two rules, that of the lower order against that of
/// the higher, and so stands above the error of the result, which is that of the higher.
class ApertureIntegrator : public FluxIntegrator {
 public:
  [[nodiscard]] Flux reflected(const Surface& surface, const MeasuringGeometry& geometry,
                               const Eigen::ArrayXd& weight, double tolerance) const override;
  [[nodiscard]] double incident(const Aperture& source) const override;
  [[nodiscard]] Flux hemispherical(const Surface& surface, const Vector3& omega_i,
                                   const Eigen::ArrayXd& weight, double tolerance) const override;
};

}  // namespace gonio

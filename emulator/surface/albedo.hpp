#pragma once

#include <functional>

#include "emulator/surface/surface.hpp"

namespace gonio {

/// Reflectance of a lobe into the hemisphere,
///
///   int g(omega_i, omega_r) factor(cos theta_d) cos theta_r d omega_r,
///
/// by the trapezoidal rule over the slopes of the half vector, which converges fast for lobes as
/// smooth as a Gaussian (to about 5e-6 with the kink of V-shaped grooves; 1e-3 of a lobe that the
/// horizon cuts). For the making of surfaces; FluxIntegrator::hemispherical is exact.
/// @param cos_theta_i  in (0, 1].
[[nodiscard]] double lobe_albedo(const Shape& shape, double parameter, double cos_theta_i,
                                 const std::function<double(double)>& factor);

}  // namespace gonio

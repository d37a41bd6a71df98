#pragma once

#include <Eigen/Core>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// rho = integral of f_r cos theta_r over the hemisphere, of light from theta_i and azimuth pi +
/// rotation. The rule is finer about the mirror direction: 46,000 directions, 1e-3 for lobes of 1
/// deg and more.
/// @return  shape (n_channels).
[[nodiscard]] Eigen::ArrayXd directional_hemispherical_reflectance(const MeasuredBrdf& brdf,
                                                                   Angle theta_i,
                                                                   Angle rotation = {});

}  // namespace gonio

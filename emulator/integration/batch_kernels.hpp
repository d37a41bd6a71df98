#pragma once

#include <Eigen/Core>

#include "emulator/optics/direction.hpp"

// The loops of the integrators over batches of directions, built like those of shape_kernels.

namespace gonio::kernel {

/// Directions through points of a tangent plane, and what they count.
/// @param u, v    coordinates, shape (n).
/// @param omega   result, unit, shape (n).
/// @param factor  multiplied by (d omega / du dv) * cos theta, 0 below the horizon; shape (n).
void tangent_directions(const Frame& frame, const Eigen::ArrayXd& u, const Eigen::ArrayXd& v,
                        DirectionBatch& omega, Eigen::ArrayXd& factor);

/// Moments sum_j f(j) T_k(x(j)) of the Chebyshev polynomials, added to `moment`, shape (n_k).
/// @param x  in [-1, 1], shape (n).   @param f  shape (n).
void add_chebyshev_moments(const Eigen::ArrayXd& x, const Eigen::ArrayXd& f,
                           Eigen::Ref<Eigen::VectorXd> moment);

/// value(j) = sum_k coefficient(k) T_k(x(j)), by Clenshaw's recurrence.
void chebyshev_series(const Eigen::VectorXd& coefficient, const Eigen::ArrayXd& x,
                      Eigen::ArrayXd& value);

/// x(j) = scale * cos theta_d(j) + shift for the pairs of omega_i and omega_r(j), in [-1, 1].
void half_angle_argument(const Vector3& omega_i, const DirectionBatch& omega_r, double scale,
                         double shift, Eigen::ArrayXd& x);

}  // namespace gonio::kernel

#include "emulator/integration/batch_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/core/multiversion.hpp"

namespace gonio::kernel {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Only `__restrict` parameters tell the compiler that so many arrays do not overlap.
// NOLINTNEXTLINE(readability-function-size): hence so many parameters
GONIO_CLONES void tangent_loop(const Frame& frame, Index n, const double* __restrict u,
                               const double* __restrict v, double* __restrict x,
                               double* __restrict y, double* __restrict z,
                               double* __restrict factor) {
  const double ax = frame.axis.x(), ay = frame.axis.y(), az = frame.axis.z();
  const double ux = frame.u.x(), uy = frame.u.y(), uz = frame.u.z();
  const double vx = frame.v.x(), vy = frame.v.y(), vz = frame.v.z();
  for (Index j = 0; j < n; ++j) {
    const double per_length = 1.0 / std::sqrt(1.0 + u[j] * u[j] + v[j] * v[j]);
    const double cos_theta = (az + u[j] * uz + v[j] * vz) * per_length;
    x[j] = (ax + u[j] * ux + v[j] * vx) * per_length;
    y[j] = (ay + u[j] * uy + v[j] * vy) * per_length;
    z[j] = cos_theta;
    const double above = cos_theta > 0.0 ? cos_theta : 0.0;
    factor[j] = factor[j] * per_length * per_length * per_length * above;
  }
}

}  // namespace

void tangent_directions(const Frame& frame, const ArrayXd& u, const ArrayXd& v,
                        DirectionBatch& omega, ArrayXd& factor) {
  tangent_loop(frame, u.size(), u.data(), v.data(), omega.x.data(), omega.y.data(), omega.z.data(),
               factor.data());
}

GONIO_CLONES void add_chebyshev_moments(const ArrayXd& x, const ArrayXd& f,
                                        Eigen::Ref<VectorXd> moment) {
  constexpr Index lanes = 8;
  constexpr Index block = 128;  // what stays in registers and the nearest cache
  double x2[block];
  double last[block];
  double now[block];
  for (Index begin = 0; begin < x.size(); begin += block) {
    const Index here = std::min(block, x.size() - begin);
    const Index padded = (here + lanes - 1) / lanes * lanes;
    for (Index j = 0; j < here; ++j) {
      x2[j] = 2.0 * x.data()[begin + j];
      now[j] = f.data()[begin + j];
      last[j] = 0.5 * x2[j] * now[j];  // f T_-1 = f T_1
    }
    for (Index j = here; j < padded; ++j) {
      x2[j] = now[j] = last[j] = 0.0;
    }
    for (Index k = 0; k < moment.size(); ++k) {
      double sum[lanes] = {};
      for (Index j = 0; j < padded; j += lanes) {
        for (Index l = 0; l < lanes; ++l) {
          sum[l] += now[j + l];
          const double next = x2[j + l] * now[j + l] - last[j + l];
          last[j + l] = now[j + l];
          now[j + l] = next;
        }
      }
      moment(k) +=
          ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    }
  }
}

GONIO_CLONES void chebyshev_series(const VectorXd& coefficient, const ArrayXd& x, ArrayXd& value) {
  constexpr Index lanes = 8;
  const double* __restrict xs = x.data();
  double* __restrict out = value.data();
  const Index n = x.size();
  for (Index j = 0; j < n; j += lanes) {
    double x2[lanes] = {};
    double b1[lanes] = {};
    double b2[lanes] = {};
    const Index here = n - j < lanes ? n - j : lanes;
    for (Index l = 0; l < here; ++l) {
      x2[l] = 2.0 * xs[j + l];
    }
    for (Index k = coefficient.size() - 1; k > 0; --k) {
      const double c = coefficient.data()[k];
      for (Index l = 0; l < lanes; ++l) {
        const double b0 = c + x2[l] * b1[l] - b2[l];
        b2[l] = b1[l];
        b1[l] = b0;
      }
    }
    for (Index l = 0; l < here; ++l) {
      out[j + l] = coefficient.data()[0] + 0.5 * x2[l] * b1[l] - b2[l];
    }
  }
}

GONIO_CLONES void half_angle_argument(const Vector3& omega_i, const DirectionBatch& omega_r,
                                      double scale, double shift, ArrayXd& x) {
  const double ix = omega_i.x(), iy = omega_i.y(), iz = omega_i.z();
  const double* __restrict rx = omega_r.x.data();
  const double* __restrict ry = omega_r.y.data();
  const double* __restrict rz = omega_r.z.data();
  double* __restrict out = x.data();
  const Index n = omega_r.size();
  for (Index j = 0; j < n; ++j) {
    const double cos2 = 0.5 * (1.0 + ix * rx[j] + iy * ry[j] + iz * rz[j]);
    const double value = scale * std::sqrt(cos2 > 0.0 ? cos2 : 0.0) + shift;
    const double above = value > -1.0 ? value : -1.0;
    out[j] = above < 1.0 ? above : 1.0;
  }
}

}  // namespace gonio::kernel

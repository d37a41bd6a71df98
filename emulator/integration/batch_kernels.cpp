#include "emulator/integration/batch_kernels.hpp"

#include <cmath>

#include "emulator/core/multiversion.hpp"

namespace gonio::kernel {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

GONIO_CLONES void tangent_directions(const Frame& frame, const ArrayXd& u, const ArrayXd& v,
                                     DirectionBatch& omega, ArrayXd& factor) {
  const double ax = frame.axis.x(), ay = frame.axis.y(), az = frame.axis.z();
  const double ux = frame.u.x(), uy = frame.u.y(), uz = frame.u.z();
  const double vx = frame.v.x(), vy = frame.v.y(), vz = frame.v.z();
  const double* __restrict us = u.data();
  const double* __restrict vs = v.data();
  double* __restrict x = omega.x.data();
  double* __restrict y = omega.y.data();
  double* __restrict z = omega.z.data();
  double* __restrict f = factor.data();
  const Index n = u.size();
  for (Index j = 0; j < n; ++j) {
    const double per_length = 1.0 / std::sqrt(1.0 + us[j] * us[j] + vs[j] * vs[j]);
    const double cos_theta = (az + us[j] * uz + vs[j] * vz) * per_length;
    x[j] = (ax + us[j] * ux + vs[j] * vx) * per_length;
    y[j] = (ay + us[j] * uy + vs[j] * vy) * per_length;
    z[j] = cos_theta;
    const double projected = per_length * per_length * per_length * cos_theta;
    f[j] *= cos_theta > 0.0 ? projected : 0.0;
  }
}

GONIO_CLONES void add_chebyshev_moments(const ArrayXd& x, const ArrayXd& f,
                                        Eigen::Ref<VectorXd> moment) {
  constexpr Index lanes = 8;
  constexpr Index most_terms = 128;
  const Index terms = moment.size() < most_terms ? moment.size() : most_terms;
  double sum[most_terms][lanes];
  for (Index k = 0; k < terms; ++k) {
    for (Index l = 0; l < lanes; ++l) {
      sum[k][l] = 0.0;
    }
  }
  const Index n = x.size();
  for (Index j = 0; j < n; j += lanes) {
    double x2[lanes] = {};
    double last[lanes] = {};
    double now[lanes] = {};
    const Index here = n - j < lanes ? n - j : lanes;
    for (Index l = 0; l < here; ++l) {
      x2[l] = 2.0 * x.data()[j + l];
      now[l] = f.data()[j + l];
      last[l] = 0.5 * x2[l] * now[l];  // f T_-1 = f T_1
    }
    for (Index k = 0; k < terms; ++k) {
      for (Index l = 0; l < lanes; ++l) {
        sum[k][l] += now[l];
        const double next = x2[l] * now[l] - last[l];
        last[l] = now[l];
        now[l] = next;
      }
    }
  }
  for (Index k = 0; k < terms; ++k) {
    double total = 0.0;
    for (Index l = 0; l < lanes; ++l) {
      total += sum[k][l];
    }
    moment(k) += total;
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

#include "emulator/surface/shape_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "emulator/core/multiversion.hpp"

#define GONIO_INLINE [[gnu::always_inline]] inline

namespace gonio::kernel {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double pi = std::numbers::pi;

/// exp(x) for x <= 0, to 3e-16 relative down to x = -700 and exp(-700) below it; no branch.
GONIO_INLINE double exp_of_negative(double x) {
  constexpr double to_integer = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  x = x > -700.0 ? x : -700.0;
  const double shifted = x * std::numbers::log2e + to_integer;
  const double k = shifted - to_integer;
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0 / 479001600.0;  // of the series up to r^12 / 12!
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  sum = sum * r + 1.0;
  sum = sum * r + 1.0;
  const auto exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52;
  return sum * std::bit_cast<double>(exponent);
}

/// 1 - exp(-x) for x >= 0, to 1e-14 relative; no branch.
GONIO_INLINE double one_minus_exp_of_negative(double x) {
  constexpr double small = 0.02;
  double series = 1.0 - x * (1.0 / 7.0);
  series = 1.0 - x * (1.0 / 6.0) * series;
  series = 1.0 - x * (1.0 / 5.0) * series;
  series = 1.0 - x * (1.0 / 4.0) * series;
  series = 1.0 - x * (1.0 / 3.0) * series;
  series = x * (1.0 - x * 0.5 * series);
  return x < small ? series : 1.0 - exp_of_negative(-x);
}

/// What a kernel needs of a pair of directions; h = omega_i + omega_r is not normalised.
struct Pair {
  double hx, hy, hz;
  double half_h2;  // h.h / 2 = 1 + omega_i.omega_r = 2 cos^2 d
  double cos_i, cos_r;
  bool visible;

  [[nodiscard]] GONIO_INLINE double tan2_a() const { return (hx * hx + hy * hy) / (hz * hz); }
  [[nodiscard]] GONIO_INLINE double inverse_cos4_a() const {
    const double inverse_cos2 = 2.0 * half_h2 / (hz * hz);
    return inverse_cos2 * inverse_cos2;
  }
  /// G / (4 cos i cos r) of V-shaped grooves; finite at grazing angles.
  [[nodiscard]] GONIO_INLINE double v_groove() const {
    const double open = 0.25 / (cos_i * cos_r);
    const double shadowed = hz / (2.0 * half_h2 * (cos_i > cos_r ? cos_i : cos_r));
    return open < shadowed ? open : shadowed;
  }
};

/// g(j) = evaluate(pair of omega_i and the j-th omega_r), 0 where that is below the horizon.
template <class Evaluate>
GONIO_INLINE void for_each_pair(const Vector3& omega_i, const DirectionBatch& omega_r,
                                Eigen::Ref<ArrayXd>& out, Evaluate evaluate) {
  const double ix = omega_i.x();
  const double iy = omega_i.y();
  const double iz = omega_i.z();
  const double* __restrict rx = omega_r.x.data();
  const double* __restrict ry = omega_r.y.data();
  const double* __restrict rz = omega_r.z.data();
  double* __restrict g = out.data();
  const Index n = omega_r.size();
  for (Index j = 0; j < n; ++j) {
    const bool visible = rz[j] > 0.0;
    const double cos_r = visible ? rz[j] : 1.0;
    const Pair pair{.hx = ix + rx[j],
                    .hy = iy + ry[j],
                    .hz = iz + cos_r,
                    .half_h2 = 1.0 + ix * rx[j] + iy * ry[j] + iz * cos_r,
                    .cos_i = iz,
                    .cos_r = cos_r,
                    .visible = visible};
    const double value = evaluate(pair);
    g[j] = visible ? value : 0.0;
  }
}

GONIO_INLINE double dielectric_transmittance(double n2, double c) {
  const double q = std::sqrt(n2 - 1.0 + c * c);
  const double s = (c - q) / (c + q);
  const double p = (n2 * c - q) / (n2 * c + q);
  return 1.0 - 0.5 * (s * s + p * p);
}

}  // namespace

GONIO_CLONES void beckmann_v_groove(double m, const Vector3& omega_i, const DirectionBatch& omega_r,
                                    Eigen::Ref<ArrayXd> g) {
  const double per_m2 = 1.0 / (m * m);
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    return exp_of_negative(-pair.tan2_a() * per_m2) * (per_m2 / pi) * pair.inverse_cos4_a() *
           pair.v_groove();
  });
}

GONIO_CLONES void beckmann_diffracting(double slope, double k_sigma, const Vector3& omega_i,
                                       const DirectionBatch& omega_r, Eigen::Ref<ArrayXd> g) {
  const double per_slope2 = 1.0 / (slope * slope);
  const double k2 = k_sigma * k_sigma;
  const auto per_m2 = [=](double c2) { return per_slope2 * one_minus_exp_of_negative(k2 * c2); };
  const auto weakened = [=](double c2) { return c2 / (c2 + (1.0 - c2) / per_m2(c2)); };
  const double at_i = weakened(omega_i.z() * omega_i.z());
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    const double at_d = per_m2(0.5 * pair.half_h2);
    return at_i * weakened(pair.cos_r * pair.cos_r) * exp_of_negative(-pair.tan2_a() * at_d) *
           (at_d / pi) * pair.inverse_cos4_a() * pair.v_groove();
  });
}

GONIO_CLONES void ggx_height_correlated(double alpha, const Vector3& omega_i,
                                        const DirectionBatch& omega_r, Eigen::Ref<ArrayXd> g) {
  const double a2 = alpha * alpha;
  const double root_i = std::sqrt(a2 + (1.0 - a2) * omega_i.z() * omega_i.z());
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    const double root_r = std::sqrt(a2 + (1.0 - a2) * pair.cos_r * pair.cos_r);
    const double spread = 1.0 + pair.tan2_a() / a2;
    return pair.inverse_cos4_a() /
           (2.0 * pi * a2 * spread * spread * (pair.cos_r * root_i + pair.cos_i * root_r));
  });
}

GONIO_CLONES void ggx_separable(double alpha, const Vector3& omega_i, const DirectionBatch& omega_r,
                                Eigen::Ref<ArrayXd> g) {
  const double a2 = alpha * alpha;
  const double sum_i = omega_i.z() + std::sqrt(a2 + (1.0 - a2) * omega_i.z() * omega_i.z());
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    const double sum_r = pair.cos_r + std::sqrt(a2 + (1.0 - a2) * pair.cos_r * pair.cos_r);
    const double spread = 1.0 + pair.tan2_a() / a2;
    return pair.inverse_cos4_a() / (pi * a2 * spread * spread * sum_i * sum_r);
  });
}

GONIO_CLONES void ward_bounded(double alpha_x, double alpha_y, const Vector3& omega_i,
                               const DirectionBatch& omega_r, Eigen::Ref<ArrayXd> g) {
  const double per_ax2 = 1.0 / (alpha_x * alpha_x);
  const double per_ay2 = 1.0 / (alpha_y * alpha_y);
  const double factor = 2.0 / (pi * alpha_x * alpha_y);
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    const double per_hz2 = 1.0 / (pair.hz * pair.hz);
    const double slope2 = (pair.hx * pair.hx * per_ax2 + pair.hy * pair.hy * per_ay2) * per_hz2;
    return factor * exp_of_negative(-slope2) * pair.half_h2 * per_hz2 * per_hz2;
  });
}

GONIO_CLONES void transmitted_twice(double n, const Vector3& omega_i, const DirectionBatch& omega_r,
                                    Eigen::Ref<ArrayXd> g) {
  const double n2 = n * n;
  const double factor = dielectric_transmittance(n2, omega_i.z()) / pi;
  for_each_pair(omega_i, omega_r, g, [=](const Pair& pair) {
    return factor * dielectric_transmittance(n2, pair.cos_r);
  });
}

}  // namespace gonio::kernel

#include "emulator/optics/fresnel.hpp"

#include <cmath>
#include <stdexcept>

#include "emulator/core/multiversion.hpp"

namespace gonio {

namespace {

void expect_arguments(double cos_theta_i, std::complex<double> n_hat) {
  if (!(cos_theta_i >= 0.0 && cos_theta_i <= 1.0)) {
    throw std::domain_error("fresnel: cos_theta_i must be in [0, 1], is " +
                            std::to_string(cos_theta_i));
  }
  if (!(n_hat.real() > 0.0) || !(n_hat.imag() >= 0.0)) {
    throw std::domain_error("fresnel: the refractive index needs n > 0 and k >= 0, is " +
                            std::to_string(n_hat.real()) + " + " + std::to_string(n_hat.imag()) +
                            "i");
  }
}

/// The reflectances in real arithmetic, with q = a + ib. No branch, so that it vectorises.
[[gnu::always_inline]] inline PolarisedReflectance reflectances(double c, double n, double k) {
  const double sin2 = 1.0 - c * c;
  const double re_q2 = n * n - k * k - sin2;
  const double nk = n * k;
  const double abs_q2 = std::sqrt(re_q2 * re_q2 + 4.0 * nk * nk);
  // The larger of |a| and |b| first, the other from ab = nk: no cancellation. The smallest normal
  // number keeps 0 / 0 away at the critical angle.
  const double larger = std::sqrt(0.5 * (abs_q2 + std::abs(re_q2))) + 1e-300;
  const double a = re_q2 >= 0.0 ? larger : nk / larger;
  const double ac2 = 2.0 * a * c;
  const double s = (abs_q2 - ac2 + c * c) / (abs_q2 + ac2 + c * c);
  const double even = abs_q2 * c * c + sin2 * sin2;
  return {s, s * (even - ac2 * sin2) / (even + ac2 * sin2)};
}

GONIO_CLONES void kernel_unpolarised(double cos_theta_i, const Eigen::ArrayXcd& n_hat,
                                     Eigen::ArrayXd& rho) {
  const double* __restrict parts = reinterpret_cast<const double*>(n_hat.data());
  double* __restrict out = rho.data();
  const Eigen::Index n = n_hat.size();
  for (Eigen::Index l = 0; l < n; ++l) {
    const PolarisedReflectance part = reflectances(cos_theta_i, parts[2 * l], parts[2 * l + 1]);
    out[l] = 0.5 * (part.s + part.p);
  }
}

GONIO_CLONES void kernel_difference(double cos_theta_i, const Eigen::ArrayXcd& n_hat,
                                    Eigen::ArrayXd& difference) {
  const double* __restrict parts = reinterpret_cast<const double*>(n_hat.data());
  double* __restrict out = difference.data();
  const Eigen::Index n = n_hat.size();
  for (Eigen::Index l = 0; l < n; ++l) {
    const PolarisedReflectance part = reflectances(cos_theta_i, parts[2 * l], parts[2 * l + 1]);
    out[l] = 0.5 * (part.s - part.p);
  }
}

}  // namespace

FresnelAmplitudes fresnel_amplitudes(double cos_theta_i, std::complex<double> n_hat) {
  expect_arguments(cos_theta_i, n_hat);
  const std::complex<double> n2 = n_hat * n_hat;
  const std::complex<double> q = std::sqrt(n2 - (1.0 - cos_theta_i * cos_theta_i));
  return {.s = (cos_theta_i - q) / (cos_theta_i + q),
          .p = (n2 * cos_theta_i - q) / (n2 * cos_theta_i + q)};
}

PolarisedReflectance fresnel_polarised(double cos_theta_i, std::complex<double> n_hat) {
  expect_arguments(cos_theta_i, n_hat);
  return reflectances(cos_theta_i, n_hat.real(), n_hat.imag());
}

double fresnel_reflectance(double cos_theta_i, std::complex<double> n_hat) {
  const PolarisedReflectance rho = fresnel_polarised(cos_theta_i, n_hat);
  return 0.5 * (rho.s + rho.p);
}

Eigen::ArrayXd fresnel_reflectance(double cos_theta_i, const Eigen::ArrayXcd& n_hat) {
  for (const std::complex<double>& index : n_hat) {
    expect_arguments(cos_theta_i, index);
  }
  Eigen::ArrayXd rho(n_hat.size());
  kernel_unpolarised(cos_theta_i, n_hat, rho);
  return rho;
}

Eigen::ArrayXd fresnel_difference(double cos_theta_i, const Eigen::ArrayXcd& n_hat) {
  for (const std::complex<double>& index : n_hat) {
    expect_arguments(cos_theta_i, index);
  }
  Eigen::ArrayXd difference(n_hat.size());
  kernel_difference(cos_theta_i, n_hat, difference);
  return difference;
}

double diffuse_fresnel_reflectance(double n) {
  if (!(n > 1.0)) {
    throw std::domain_error("diffuse_fresnel_reflectance: n must be > 1, is " + std::to_string(n));
  }
  const double n2 = n * n;
  const double n4 = n2 * n2;
  const double sum = n2 + 1.0;
  const double difference = n4 - 1.0;
  return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
         n2 * (n2 - 1.0) * (n2 - 1.0) / (sum * sum * sum) * std::log((n - 1.0) / (n + 1.0)) -
         2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / (sum * difference) +
         8.0 * n4 * (n4 + 1.0) / (sum * difference * difference) * std::log(n);
}

}  // namespace gonio

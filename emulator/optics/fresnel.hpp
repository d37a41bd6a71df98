#pragma once

#include <Eigen/Core>
#include <complex>

namespace gonio {

/// Reflectances of a smooth interface for light polarised perpendicular (s) and parallel (p) to the
/// plane of incidence.
struct PolarisedReflectance {
  double s = 0.0;
  double p = 0.0;
};

/// Amplitude reflection coefficients of a smooth interface.
///
///   r_p = (n^2 cos i - q) / (n^2 cos i + q),  r_s = (cos i - q) / (cos i + q),
///   q = n cos t = sqrt(n^2 - sin^2 i)
///
/// @param cos_theta_i  cosine of the angle of incidence, in [0, 1].
/// @param n_hat        complex refractive index n + ik relative to air, n > 0, k >= 0.
/// @throws std::domain_error  if an argument is outside its range or NaN.
/// @see    [Mihalik] eq. (8), (9), (12)
struct FresnelAmplitudes {
  std::complex<double> s, p;
};
[[nodiscard]] FresnelAmplitudes fresnel_amplitudes(double cos_theta_i, std::complex<double> n_hat);

/// |r_s|^2 and |r_p|^2 of fresnel_amplitudes; the same arguments, range and errors.
[[nodiscard]] PolarisedReflectance fresnel_polarised(double cos_theta_i,
                                                     std::complex<double> n_hat);

/// Specular reflectance of a smooth interface for unpolarised light.
///
///   rho = (|r_s|^2 + |r_p|^2) / 2
///
/// @param cos_theta_i  cosine of the angle of incidence, in [0, 1].
/// @param n_hat        complex refractive index n + ik relative to air, n > 0, k >= 0.
/// @return             rho, dimensionless, in [0, 1]; 1 at grazing incidence.
/// @throws std::domain_error  if an argument is outside its range or NaN.
/// @see    [Mihalik] eq. (8)-(12); eq. (10) needs |r|^2 where the index is complex
[[nodiscard]] double fresnel_reflectance(double cos_theta_i, std::complex<double> n_hat);

/// The same for many indices at one angle. @param n_hat  shape (n_lambda). @return (n_lambda).
[[nodiscard]] Eigen::ArrayXd fresnel_reflectance(double cos_theta_i, const Eigen::ArrayXcd& n_hat);

/// How much more of s than of p polarised light is reflected, (|r_s|^2 - |r_p|^2) / 2: what is to
/// be added to fresnel_reflectance for light that is polarised s, and taken off for p. The same
/// arguments, shapes and errors; the result is in [0, 1/2].
[[nodiscard]] Eigen::ArrayXd fresnel_difference(double cos_theta_i, const Eigen::ArrayXcd& n_hat);

/// Reflectance of a smooth dielectric for diffuse light from outside, int_0^1 2 rho(c) c dc.
///
/// @param n  refractive index, > 1.
/// @throws std::domain_error  if n <= 1 or NaN.
/// @see    Duntley, J. Opt. Soc. Am. 32, 61 (1942); the closed form of the integral
[[nodiscard]] double diffuse_fresnel_reflectance(double n);

}  // namespace gonio

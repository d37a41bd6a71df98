#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/measured/measured_brdf.hpp"
#include "emulator/optics/direction.hpp"

namespace gonio {

/// How wide a lobe is: rms slopes of the half vector in x and y. Infinite where the lobe fills the
/// hemisphere; an integrator grades its panels round the mirror direction with it.
struct SlopeWidth {
  double x = std::numeric_limits<double>::infinity();
  double y = std::numeric_limits<double>::infinity();
};

/// The geometry factor g of a lobe. Reciprocal, not negative, zero below the horizon, and the same
/// for a pair of directions as for that pair with both y reversed.
class Shape {
 public:
  virtual ~Shape() = default;

  /// @param parameter  the shape parameter (see Lobe); ignored by a shape that has none.
  /// @param omega_i    unit, above the surface.
  /// @param omega_r    unit, shape (n).
  /// @param g          result [1/sr], shape (n).
  virtual void evaluate(double parameter, const Vector3& omega_i, const DirectionBatch& omega_r,
                        Eigen::Ref<Eigen::ArrayXd> g) const = 0;

  /// @param cos_theta_d  cosine of the angle between the half vector and either direction, > 0.
  [[nodiscard]] virtual SlopeWidth slope_width(double parameter, double cos_theta_d) const = 0;
};

/// The colour factor s(cos theta_d) of a lobe or a smooth interface, shape (n_lambda).
using Colour = std::function<Eigen::ArrayXd(double cos_theta_d)>;

/// One term of a BRDF: geometry times colour,
///
///   f_r(lambda) = g(omega_i, omega_r; p(lambda)) * s(cos theta_d, lambda).
///
/// The shape parameter p is the one number through which wavelength may change the geometry: the
/// wavenumber where the lobe diffracts, the index where it is refracted. Most lobes have none.
struct Lobe {
  std::shared_ptr<const Shape> shape;
  Colour colour;
  Eigen::ArrayXd shape_parameter = {};  ///< (n_lambda), or empty
  Colour difference = {};               ///< as of an interface; empty for a depolarising lobe

  /// Contribution to f_r [1/sr], shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd brdf(const Vector3& omega_i, const Vector3& omega_r) const;
};

/// A smooth interface, which reflects into the mirror direction alone.
struct Interface {
  Colour colour;  ///< reflectance for unpolarised light, (R_s + R_p) / 2
  /// (R_s - R_p) / 2 for light polarised perpendicular (s) and parallel (p) to the plane of
  /// incidence; empty where both are alike.
  Colour difference = {};
};

/// A term of a BRDF that was measured, and that no geometry factors out of:
///
///   f_r(lambda) = sum_c f_c(omega_i, omega_r) spectra(c, lambda).
struct MeasuredTerm {
  std::shared_ptr<const MeasuredBrdf> brdf;
  Eigen::MatrixXd spectra = {};  ///< what a unit of each channel adds, shape (n_channels, n_lambda)
  std::vector<std::string> warnings = {};  ///< of its file

  /// Contribution to f_r [1/sr], shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd f_r(const Vector3& omega_i, const Vector3& omega_r) const;
};

/// A surface: a sum of lobes, of measured terms, and of smooth interfaces. All spectra are on one
/// wavelength grid.
struct Surface {
  WavelengthGrid grid = WavelengthGrid::visible();
  std::vector<Lobe> lobes = {};
  std::vector<Interface> interfaces = {};
  std::vector<MeasuredTerm> measured = {};

  /// Reflects into more than the mirror direction.
  [[nodiscard]] bool scatters() const { return !lobes.empty() || !measured.empty(); }
  /// f_r of all lobes and measured terms [1/sr], shape (n_lambda); without the smooth interfaces,
  /// whose f_r is a delta.
  [[nodiscard]] Eigen::ArrayXd brdf(const Vector3& omega_i, const Vector3& omega_r) const;
  /// Reflectance of the smooth interfaces into the mirror direction, shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd specular_reflectance(double cos_theta_i) const;
};

/// The surface as an instrument sees it that favours one polarisation: each colour s becomes
/// s + P d, with d the difference of polarised reflectances.
///
/// A source of degree of polarisation a and a receptor of diattenuation b, both positive for s,
/// weigh R_s with (1 + a)(1 + b) and R_p with (1 - a)(1 - b): they favour s by
///
///   P = (a + b) / (1 + a b),
///
/// so that either of them alone is enough. Of light that the surface depolarises they weigh as much
/// as of unpolarised light, to a b. The plane of incidence of each facet is taken for the plane of
/// measurement: exact in that plane, and else to the square of the angle between both planes, at
/// the edge of the receptors of ISO 2813 up to 3, 7 and 17 deg at 20, 60 and 85 deg.
///
/// @param P  in [-1, 1], positive for s.
/// @return   the same surface for P = 0.
/// @throws std::domain_error  if P is outside its range.
[[nodiscard]] Surface polarised(const Surface& surface, double P);

/// cos theta_d of each pair, sqrt((1 + omega_i.omega_r) / 2), shape (n).
void half_angle_cosine(const Vector3& omega_i, const DirectionBatch& omega_r,
                       Eigen::Ref<Eigen::ArrayXd> cos_theta_d);

}  // namespace gonio

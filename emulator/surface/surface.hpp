#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
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

  /// Contribution to f_r [1/sr], shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd brdf(const Vector3& omega_i, const Vector3& omega_r) const;
};

/// A surface: a sum of lobes, and of smooth interfaces, which reflect into the mirror direction
/// alone. All spectra are on one wavelength grid.
struct Surface {
  WavelengthGrid grid = WavelengthGrid::visible();
  std::vector<Lobe> lobes = {};
  std::vector<Colour> interfaces = {};

  /// f_r of all lobes [1/sr], shape (n_lambda); without the smooth interfaces, whose f_r is a
  /// delta.
  [[nodiscard]] Eigen::ArrayXd brdf(const Vector3& omega_i, const Vector3& omega_r) const;
  /// Reflectance of the smooth interfaces into the mirror direction, shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd specular_reflectance(double cos_theta_i) const;
};

/// cos theta_d of each pair, sqrt((1 + omega_i.omega_r) / 2), shape (n).
void half_angle_cosine(const Vector3& omega_i, const DirectionBatch& omega_r,
                       Eigen::Ref<Eigen::ArrayXd> cos_theta_d);

}  // namespace gonio

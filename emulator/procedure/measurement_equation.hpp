#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "emulator/core/angle.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/instrument/uncertainty_statement.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio {

/// How a reading comes about from what the optics see, with the names of Behaviour:
///
///   G = (V + d_V) (R(n + d_n) / R(n)) * (l(g) + z) / (l((1 - c) V) + z)
///       * (1 + d_drift) (1 + a d_T) + d_resolution + d_repeatability,
///   l(g) = g + 4 L g (1 - g / full_scale)
///
/// g: what the optics read of the sample, with the tile read through the same set-up; V: the value
/// of the scale; R: Fresnel's reflectance of the reference glass at theta_i; d_...: the components
/// of UncertaintyComponent, L the linearity, z the zero, a signal_per_k, c the share of its gloss
/// that the tile has lost. d_n and d_V are what the index and the value that the standards are
/// taken for have too much: with either, all readings are too high. On a scale relative to the
/// incident flux R is left out.
struct MeasurementEquation {
  /// Values of the components, or changes with them, in the order of UncertaintyComponent.
  template <class T>
  using Components = std::array<T, uncertainty_component_count>;

  /// Derivatives of a reading.
  struct Gradient {
    double reading = 0.0;
    double by_optics = 0.0;  ///< dG/dg
    /// Per unit of the component; 0 for the two that act in the optics.
    Components<double> by_component = {};
  };

  Scale scale;
  Angle theta_i = {};          ///< nominal
  double full_scale_gu = 0.0;  ///< 0: the detector is linear, and `linearity` changes nothing
  double signal_per_k = 0.0;
  double tile_contamination = 0.0;  ///< in [0, 1)

  /// @param T  double, or a number that carries derivatives.
  /// @param d  values of the components in the order of UncertaintyComponent; the two that act in
  ///           the optics are not used.
  template <class T>
  [[nodiscard]] T reading(const T& g, const Components<T>& d) const {
    return reading(gain(d), g, d);
  }

  /// What all samples have in common that are read with the same tile and detector, per GU of
  /// signal: for many of them it is computed once.
  template <class T>
  [[nodiscard]] T gain(const Components<T>& d) const;
  template <class T>
  [[nodiscard]] T reading(const T& gain, const T& g, const Components<T>& d) const {
    return gain * signal(g, d) + of(d, UncertaintyComponent::resolution) +
           of(d, UncertaintyComponent::repeatability);
  }

  /// By automatic differentiation.
  [[nodiscard]] Gradient gradient(double g, const Components<double>& d) const;

 private:
  template <class T>
  [[nodiscard]] static const T& of(const Components<T>& d, UncertaintyComponent component) {
    return d[std::size_t(component)];
  }
  /// l(g) + z.
  template <class T>
  [[nodiscard]] T signal(const T& g, const Components<T>& d) const;
  /// R(n), twice, for n above sin theta_i.
  template <class T>
  [[nodiscard]] T glass_reflectance(const T& n) const;
};

/// The equation of one geometry of an instrument, as its file describes it.
/// @throws std::out_of_range  if the instrument has no such geometry.
[[nodiscard]] MeasurementEquation measurement_equation(const Instrument& instrument,
                                                       const std::string& geometry_id);

template <class T>
T MeasurementEquation::gain(const Components<T>& d) const {
  const double value = scale.value.nominal;
  const T assigned = value + of(d, UncertaintyComponent::reference_value);
  const T since_calibration = (1.0 + of(d, UncertaintyComponent::drift)) *
                              (1.0 + signal_per_k * of(d, UncertaintyComponent::temperature));
  const T result = assigned * since_calibration / signal(T((1.0 - tile_contamination) * value), d);
  if (scale.reference == Scale::Reference::incident_flux) {
    return result;
  }
  const double n = scale.refractive_index->nominal;
  return result * glass_reflectance(T(n + of(d, UncertaintyComponent::reference_index))) /
         glass_reflectance(n);
}

template <class T>
T MeasurementEquation::signal(const T& g, const Components<T>& d) const {
  const T& zero = of(d, UncertaintyComponent::zero);
  if (full_scale_gu == 0.0) {
    return g + zero;
  }
  const T error = 4.0 * of(d, UncertaintyComponent::linearity) * g * (1.0 - g / full_scale_gu);
  return g + error + zero;
}

template <class T>
T MeasurementEquation::glass_reflectance(const T& n) const {
  using std::sqrt;
  const double cos_i = std::cos(theta_i.radians());
  const T n2 = n * n;
  const T n_cos_t = sqrt(T(n2 - (1.0 - cos_i * cos_i)));
  const T r_s = (cos_i - n_cos_t) / (cos_i + n_cos_t);
  const T r_p = (n2 * cos_i - n_cos_t) / (n2 * cos_i + n_cos_t);
  return r_s * r_s + r_p * r_p;
}

}  // namespace gonio

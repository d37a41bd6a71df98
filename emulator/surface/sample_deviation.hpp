#pragma once

#include <array>
#include <cstddef>

namespace gonio {

/// What of a coating may depart from its sample file.
enum class SampleParameter { roughness, refractive_index, diffuse_reflectance };
constexpr std::size_t sample_parameter_count = 3;

/// As input files and people call them, in the order of SampleParameter.
inline constexpr std::array<const char*, sample_parameter_count> sample_parameter_names{
    "roughness", "refractive_index", "diffuse_reflectance"};

/// How a coating departs from its sample file. A parameter that a model has not stays without
/// effect on it.
struct SampleDeviation {
  /// ln(m / m_0) of rms_slope, alpha, alpha_x, alpha_y and rms_height.
  double roughness = 0.0;
  /// Added to n at all wavelengths.
  double refractive_index = 0.0;
  /// Added to `diffuse`, `base`, or the `reflectance` of a Lambertian surface at all wavelengths,
  /// and kept within [0, what `specular` leaves].
  double diffuse_reflectance = 0.0;

  bool operator==(const SampleDeviation&) const = default;
  [[nodiscard]] double& operator[](SampleParameter parameter);
  [[nodiscard]] double operator[](SampleParameter parameter) const;
};

/// Both departures, one after the other.
[[nodiscard]] SampleDeviation operator+(const SampleDeviation& a, const SampleDeviation& b);

}  // namespace gonio

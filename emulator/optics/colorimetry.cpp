#include "emulator/optics/colorimetry.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/core/angle.hpp"
#include "emulator/core/table.hpp"

namespace gonio {

namespace {

double lab_function(double t) {
  constexpr double cube_root_above = 216.0 / 24389.0;  // (6/29)^3
  return t > cube_root_above ? std::cbrt(t) : 841.0 / 108.0 * t + 4.0 / 29.0;
}

double sin_deg(double angle_deg) { return std::sin(degrees(angle_deg).radians()); }
double cos_deg(double angle_deg) { return std::cos(degrees(angle_deg).radians()); }

double from_0_to_360(double angle_deg) { return angle_deg - 360.0 * std::floor(angle_deg / 360.0); }

/// Lightness, chroma, and hue angle in [0, 360) deg: its range decides between the two arcs from a
/// hue to its opposite.
struct Lch {
  double L;
  double C;
  double h_deg;
};

/// CIEDE2000 stretches a* by a factor that counts for colours near grey.
Lch stretched(const Lab& colour, double factor) {
  const double a = factor * colour.a;
  return {.L = colour.L,
          .C = std::hypot(a, colour.b),
          .h_deg = from_0_to_360(radians(std::atan2(colour.b, a)).degrees())};
}

/// C^7 / (C^7 + 25^7) under the root.
double chroma_root(double C) {
  const double C_7 = std::pow(C, 7);
  return std::sqrt(C_7 / (C_7 + 6103515625.0));
}

}  // namespace

Observer Observer::load(const std::filesystem::path& path, const WavelengthGrid& grid) {
  const auto column = [&](const char* name) {
    return SpectralTable::load(path, name).sample(grid);
  };
  return {.x_bar = column("x_bar"), .y_bar = column("y_bar"), .z_bar = column("z_bar")};
}

Xyz tristimulus(const Eigen::ArrayXd& reflectance, const Eigen::ArrayXd& illuminant,
                const Observer& observer) {
  const Eigen::Index n = illuminant.size();
  if (reflectance.size() != n || observer.x_bar.size() != n || observer.y_bar.size() != n ||
      observer.z_bar.size() != n) {
    throw std::invalid_argument("tristimulus: arrays of different lengths");
  }
  const double luminous = (illuminant * observer.y_bar).sum();
  if (!(luminous > 0.0)) {
    throw std::invalid_argument("tristimulus: the illuminant has no luminous power");
  }
  const Eigen::ArrayXd light = 100.0 / luminous * reflectance * illuminant;
  return {.X = (light * observer.x_bar).sum(),
          .Y = (light * observer.y_bar).sum(),
          .Z = (light * observer.z_bar).sum()};
}

Xyz white_point(const Eigen::ArrayXd& illuminant, const Observer& observer) {
  return tristimulus(Eigen::ArrayXd::Ones(illuminant.size()), illuminant, observer);
}

Chromaticity chromaticity(const Xyz& colour) {
  const double sum = colour.X + colour.Y + colour.Z;
  if (!(sum > 0.0)) {
    throw std::domain_error("chromaticity: needs X + Y + Z > 0");
  }
  return {.x = colour.X / sum, .y = colour.Y / sum};
}

Lab cielab(const Xyz& colour, const Xyz& white) {
  if (!(white.X > 0.0 && white.Y > 0.0 && white.Z > 0.0)) {
    throw std::domain_error("cielab: needs a white point > 0");
  }
  const double f_x = lab_function(colour.X / white.X);
  const double f_y = lab_function(colour.Y / white.Y);
  const double f_z = lab_function(colour.Z / white.Z);
  return {.L = 116.0 * f_y - 16.0, .a = 500.0 * (f_x - f_y), .b = 200.0 * (f_y - f_z)};
}

double ciede2000(const Lab& first, const Lab& second, const Ciede2000Weights& weights) {
  const double C_ab = (std::hypot(first.a, first.b) + std::hypot(second.a, second.b)) / 2.0;
  const double stretch = 1.0 + 0.5 * (1.0 - chroma_root(C_ab));
  const Lch one = stretched(first, stretch);
  const Lch two = stretched(second, stretch);

  // The shorter way round, and the hue half way along it. The hue of a grey is any number: its
  // chroma of 0 makes delta_H 0, and nothing else depends on the hue then.
  const double delta_h_deg = std::remainder(two.h_deg - one.h_deg, 360.0);
  const double delta_L = two.L - one.L;
  const double delta_C = two.C - one.C;
  const double delta_H = 2.0 * std::sqrt(one.C * two.C) * sin_deg(delta_h_deg / 2.0);

  const double C = (one.C + two.C) / 2.0;
  const double h = from_0_to_360(one.h_deg + delta_h_deg / 2.0);
  const double L_50 = std::pow((one.L + two.L) / 2.0 - 50.0, 2);
  const double T = 1.0 - 0.17 * cos_deg(h - 30.0) + 0.24 * cos_deg(2.0 * h) +
                   0.32 * cos_deg(3.0 * h + 6.0) - 0.20 * cos_deg(4.0 * h - 63.0);
  const double S_L = 1.0 + 0.015 * L_50 / std::sqrt(20.0 + L_50);
  const double S_C = 1.0 + 0.045 * C;
  const double S_H = 1.0 + 0.015 * C * T;
  const double rotation_deg = 60.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2));
  const double R_T = -2.0 * chroma_root(C) * sin_deg(rotation_deg);

  const double lightness = delta_L / (weights.k_L * S_L);
  const double chroma = delta_C / (weights.k_C * S_C);
  const double hue = delta_H / (weights.k_H * S_H);
  return std::sqrt(lightness * lightness + chroma * chroma + hue * hue + R_T * chroma * hue);
}

}  // namespace gonio

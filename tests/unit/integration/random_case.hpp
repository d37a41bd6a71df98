#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/integration/glossmeter.hpp"

namespace gonio::test {

/// Three wavelengths, over which materials have a colour, and their weights.
inline const WavelengthGrid three_wavelengths(nanometres(450), nanometres(100), 3);
inline Eigen::ArrayXd three_weights() { return Eigen::Array3d(0.2, 0.5, 0.3); }

/// A measurement at random: surface, geometry and the tolerance asked for.
struct RandomCase {
  std::string text;  ///< all parameters, to find it again
  Surface surface;
  MeasuringGeometry geometry;
  double standard_flux;  ///< of polished glass of index 1.567 that fills the receptor [sr]
  double tolerance_gu;

  [[nodiscard]] double tolerance() const { return 0.01 * tolerance_gu * standard_flux; }
};

/// What cases are drawn from: rms slopes (or alpha) and tolerances, both uniform in the logarithm.
struct CaseRange {
  double least_width, most_width;
  double least_tolerance_gu, most_tolerance_gu;
};

/// Draws cases of one model after another.
class CaseSource {
 public:
  CaseSource(unsigned seed, const CaseRange& range) : random_(seed), range_(range) {}

  RandomCase next(const std::string& model) {
    text_.str({});
    text_ << model;
    Surface surface = draw_surface(model);
    const double theta = draw_theta();
    const Aperture source = draw_source(theta);
    const Aperture receptor = draw_receptor(theta);
    const double tolerance_gu =
        logarithmic("tolerance_gu", range_.least_tolerance_gu, range_.most_tolerance_gu);
    const double rho = fresnel_reflectance(std::max(source.frame().axis.z(), 0.0), 1.567);
    return {text_.str(),
            std::move(surface),
            {source, receptor},
            rho * ApertureIntegrator().incident(source),
            tolerance_gu};
  }

 private:
  double uniform(const char* name, double low, double high) {
    const double value = std::uniform_real_distribution<double>(low, high)(random_);
    text_ << ", " << name << " " << value;
    return value;
  }
  double logarithmic(const char* name, double low, double high) {
    const double value =
        std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random_));
    text_ << ", " << name << " " << value;
    return value;
  }
  int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  Eigen::ArrayXcd draw_index() {
    switch (one_of(3)) {
      case 0:
        text_ << ", n 1.567";
        return constant_index(1.567, three_wavelengths);
      case 1:
        text_ << ", dispersive glass";
        return Eigen::Array3cd(1.58, 1.565, 1.555);
      default:
        text_ << ", copper-like";
        return Eigen::Array3cd({1.15, 2.4}, {0.95, 2.58}, {0.21, 3.67});
    }
  }

  Surface draw_surface(const std::string& model) {
    const WavelengthGrid& grid = three_wavelengths;
    const Amplitudes both{.specular = 0.6, .diffuse = Eigen::Array3d(0.1, 0.3, 0.2)};
    if (model == "smooth") {
      return smooth(grid, draw_index());
    }
    if (model == "lambertian") {
      return lambertian(grid, both.diffuse);
    }
    if (model == "coherent_roughness") {
      // Where sigma is small, the rms slope is lambda / (2 pi T cos theta), here at 550 nm.
      const double width = logarithmic("width", range_.least_width, 0.1);
      const double length_um = 0.55 / (2.0 * std::numbers::pi * width);
      return coherent_roughness(grid, nanometres(logarithmic("sigma_nm", 5.0, 1000.0)),
                                micrometres(length_um), draw_index());
    }
    const double width = logarithmic("width", range_.least_width, range_.most_width);
    const Amplitudes amplitudes = one_of(2) == 0 ? Amplitudes{} : both;
    text_ << ", k_s " << amplitudes.specular;
    if (model == "cook_torrance") {
      return cook_torrance(grid, width, draw_index(), amplitudes);
    }
    if (model == "ggx_height_correlated") {
      return ggx(grid, width, draw_index(), amplitudes);
    }
    if (model == "ggx_separable") {
      return ggx(grid, width, draw_index(), amplitudes, Masking::separable);
    }
    if (model == "ward") {
      return ward(grid, width, std::min(1.0, width * logarithmic("ratio", 0.2, 5.0)), amplitudes);
    }
    return coated(grid, both.diffuse, Eigen::Array3d(1.58, 1.565, 1.555),
                  one_of(4) == 0 ? 0.0 : width);
  }

  double draw_theta() {
    constexpr std::array<double, 5> nominal{20.0, 45.0, 60.0, 75.0, 85.0};
    const int pick = one_of(7);
    const double theta = pick < 5 ? nominal[std::size_t(pick)]
                                  : std::uniform_real_distribution<double>(5.0, 86.0)(random_);
    text_ << ", theta " << theta;
    return theta;
  }

  Aperture draw_source(double theta) {
    const Frame frame = source_frame(degrees(theta));
    switch (one_of(4)) {
      case 0:
        text_ << ", collimated";
        return collimated(frame.axis);
      case 1: {
        return Aperture::circle(frame, degrees(uniform("source circle", 0.1, 3.0)));
      }
      case 2: {
        const double in_plane = uniform("source", 0.05, 4.0);
        return Aperture::rectangle(frame, degrees(in_plane), degrees(uniform("x", 0.05, 4.0)));
      }
      default:
        text_ << ", source image";
        return source_image(theta);
    }
  }

  Aperture draw_receptor(double theta) {
    const bool is_aligned = one_of(3) == 0;
    const double off = is_aligned ? 0.0 : uniform("receptor off", -1.0, 1.0);
    const Frame frame = receptor_frame(degrees(theta + off));
    if (one_of(4) == 0) {
      return Aperture::circle(frame, degrees(uniform("receptor circle", 0.5, 8.0)));
    }
    const ReceptorSize& size = iso_receptors[std::size_t(one_of(3))];
    const bool is_swapped = one_of(3) == 0;
    text_ << ", receptor " << size.in_plane_deg << " x " << size.perpendicular_deg
          << (is_swapped ? " swapped" : "");
    const Angle in_plane = degrees(size.in_plane_deg);
    const Angle perpendicular = degrees(size.perpendicular_deg);
    return is_swapped ? Aperture::rectangle(frame, perpendicular, in_plane)
                      : Aperture::rectangle(frame, in_plane, perpendicular);
  }

  std::mt19937 random_;
  CaseRange range_;
  std::ostringstream text_;
};

}  // namespace gonio::test

#include "emulator/surface/models.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/optics/fresnel.hpp"
#include "emulator/surface/albedo.hpp"
#include "emulator/surface/shape_kernels.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;
using std::numbers::pi;

/// k_d + k_s may pass 1 by the rounding of their sum.
constexpr double rounding = 1e-12;

void expect(bool holds, const char* what, double found) {
  if (!holds) {
    throw std::domain_error(fmt::format("{}, is {}", what, found));
  }
}

class BeckmannShape : public Shape {
 public:
  explicit BeckmannShape(double m) : m_(m) {}
  void evaluate(double, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    kernel::beckmann_v_groove(m_, omega_i, omega_r, g);
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override { return {m_, m_}; }

 private:
  double m_;
};

class GgxShape : public Shape {
 public:
  GgxShape(double alpha, Masking masking) : alpha_(alpha), masking_(masking) {}
  void evaluate(double, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    if (masking_ == Masking::separable) {
      kernel::ggx_separable(alpha_, omega_i, omega_r, g);
    } else {
      kernel::ggx_height_correlated(alpha_, omega_i, omega_r, g);
    }
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override { return {alpha_, alpha_}; }

 private:
  double alpha_;
  Masking masking_;
};

class WardShape : public Shape {
 public:
  WardShape(double alpha_x, double alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}
  void evaluate(double, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    kernel::ward_bounded(alpha_x_, alpha_y_, omega_i, omega_r, g);
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override {
    return {alpha_x_, alpha_y_};
  }

 private:
  double alpha_x_;
  double alpha_y_;
};

class LambertShape : public Shape {
 public:
  void evaluate(double, const Vector3&, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    g = (omega_r.z > 0.0).select(ArrayXd::Constant(omega_r.size(), 1.0 / pi), 0.0);
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override { return {}; }
};

/// The scattered lobe of coherent_roughness; the parameter is 1 / lambda [1/nm].
class DiffractingShape : public Shape {
 public:
  DiffractingShape(Length rms_height, Length correlation_length)
      : sigma_(rms_height.nanometres()), slope_(2.0 * sigma_ / correlation_length.nanometres()) {}
  void evaluate(double per_lambda, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    kernel::beckmann_diffracting(slope_, 4.0 * pi * sigma_ * per_lambda, omega_i, omega_r, g);
  }
  [[nodiscard]] SlopeWidth slope_width(double per_lambda, double cos_theta_d) const override {
    const double phase = 4.0 * pi * sigma_ * per_lambda * cos_theta_d;
    const double m = slope_ / std::sqrt(-std::expm1(-phase * phase));
    return {m, m};
  }

 private:
  double sigma_;
  double slope_;
};

/// The diffuse part of coated; the parameter is the refractive index.
class TransmittedShape : public Shape {
 public:
  void evaluate(double n, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    kernel::transmitted_twice(n, omega_i, omega_r, g);
  }
  [[nodiscard]] SlopeWidth slope_width(double, double) const override { return {}; }
};

Colour constant(const ArrayXd& spectrum) {
  return [spectrum](double) { return spectrum; };
}

/// The product of a colour and a factor that depends on angle; empty if the colour is.
template <class Factor>
Colour times(const Colour& colour, Factor factor) {
  if (!colour) {
    return {};
  }
  return [colour, factor](double cos_theta) -> ArrayXd {
    return colour(cos_theta) * factor(cos_theta);
  };
}

Colour fresnel(double factor, const ArrayXcd& n_hat) {
  return [factor, n_hat](double cos_theta) -> ArrayXd {
    return factor * fresnel_reflectance(std::min(cos_theta, 1.0), n_hat);
  };
}

Colour difference(double factor, const ArrayXcd& n_hat) {
  return [factor, n_hat](double cos_theta) -> ArrayXd {
    return factor * fresnel_difference(std::min(cos_theta, 1.0), n_hat);
  };
}

void expect_reflectance(const ArrayXd& reflectance) {
  expect((reflectance >= 0.0).all() && (reflectance <= 1.0).all(),
         "reflectance must be in [0, 1] at all wavelengths", reflectance.maxCoeff());
}

Lobe lambertian_lobe(const ArrayXd& reflectance) {
  expect_reflectance(reflectance);
  return {.shape = std::make_shared<LambertShape>(), .colour = constant(reflectance)};
}

/// The surface of a specular lobe over a diffuse one.
Surface with_diffuse(const WavelengthGrid& grid, Lobe specular, const Amplitudes& amplitudes) {
  expect(amplitudes.specular >= 0.0 && amplitudes.specular <= 1.0, "k_s must be in [0, 1]",
         amplitudes.specular);
  Surface surface{.grid = grid};
  surface.lobes.push_back(std::move(specular));
  if (amplitudes.diffuse.size() > 0) {
    const double sum = amplitudes.specular + amplitudes.diffuse.maxCoeff();
    expect(sum <= 1.0 + rounding, "k_d + k_s must be <= 1", sum);
    if ((amplitudes.diffuse > 0.0).any()) {
      surface.lobes.push_back(lambertian_lobe(amplitudes.diffuse));
    }
  }
  return surface;
}

/// The largest factor <= 1 on what passes a rough interface twice that keeps eq. (7).
double transmitted_share(double m, double n) {
  constexpr int incidences = 90;
  constexpr double margin = 1e-5;  // between the incidences, and of lobe_albedo
  const BeckmannShape shape(m);
  double share = 1.0;
  for (int i = 0; i < incidences; ++i) {
    const double cos_theta_i = (i + 0.5) / incidences;
    const double reflected =
        lobe_albedo(shape, 0.0, cos_theta_i, [n](double c) { return fresnel_reflectance(c, n); });
    share =
        std::min(share, (1.0 - margin - reflected) / (1.0 - fresnel_reflectance(cos_theta_i, n)));
  }
  return share;
}

}  // namespace

Surface smooth(const WavelengthGrid& grid, const ArrayXcd& n_hat) {
  Surface surface{.grid = grid};
  surface.interfaces.push_back({fresnel(1.0, n_hat), difference(1.0, n_hat)});
  return surface;
}

Surface smooth(const WavelengthGrid& grid, double reflectance) {
  const ArrayXd spectrum = ArrayXd::Constant(grid.size(), reflectance);
  expect_reflectance(spectrum);
  Surface surface{.grid = grid};
  surface.interfaces.push_back({constant(spectrum)});
  return surface;
}

Surface lambertian(const WavelengthGrid& grid, const ArrayXd& reflectance) {
  Surface surface{.grid = grid};
  surface.lobes.push_back(lambertian_lobe(reflectance));
  return surface;
}

Surface cook_torrance(const WavelengthGrid& grid, double rms_slope, const ArrayXcd& n_hat,
                      const Amplitudes& amplitudes, Normalization normalization) {
  expect(rms_slope > 0.0, "rms_slope must be > 0", rms_slope);
  const double printed = normalization == Normalization::as_printed ? 4.0 : 1.0;
  return with_diffuse(grid,
                      {.shape = std::make_shared<BeckmannShape>(rms_slope),
                       .colour = fresnel(printed * amplitudes.specular, n_hat),
                       .difference = difference(printed * amplitudes.specular, n_hat)},
                      amplitudes);
}

Surface ggx(const WavelengthGrid& grid, double alpha, const ArrayXcd& n_hat,
            const Amplitudes& amplitudes, Masking masking) {
  expect(alpha > 0.0 && alpha <= 1.0, "alpha must be in (0, 1]", alpha);
  return with_diffuse(grid,
                      {.shape = std::make_shared<GgxShape>(alpha, masking),
                       .colour = fresnel(amplitudes.specular, n_hat),
                       .difference = difference(amplitudes.specular, n_hat)},
                      amplitudes);
}

Surface ward(const WavelengthGrid& grid, double alpha_x, double alpha_y,
             const Amplitudes& amplitudes) {
  expect(alpha_x > 0.0, "alpha_x must be > 0", alpha_x);
  expect(alpha_y > 0.0, "alpha_y must be > 0", alpha_y);
  const ArrayXd specular = ArrayXd::Constant(grid.size(), amplitudes.specular);
  return with_diffuse(
      grid, {.shape = std::make_shared<WardShape>(alpha_x, alpha_y), .colour = constant(specular)},
      amplitudes);
}

Surface coherent_roughness(const WavelengthGrid& grid, Length rms_height, Length correlation_length,
                           const ArrayXcd& n_hat) {
  const double sigma = rms_height.nanometres();
  expect(sigma >= 0.0, "rms_height must be >= 0 nm", sigma);
  expect(correlation_length.nanometres() > 0.0, "correlation_length must be > 0 nm",
         correlation_length.nanometres());
  if (sigma == 0.0) {
    return smooth(grid, n_hat);
  }
  const ArrayXd k_sigma = 4.0 * pi * sigma / grid.nanometres();
  Surface surface{.grid = grid};
  const Colour even = fresnel(1.0, n_hat);
  const Colour odd = difference(1.0, n_hat);
  const auto coherent = [k_sigma](double cos_theta_i) -> ArrayXd {
    return (-(k_sigma * cos_theta_i).square()).exp();
  };
  const auto scattered = [k_sigma](double cos_theta_d) -> ArrayXd {
    return -(-(k_sigma * cos_theta_d).square()).unaryExpr([](double x) { return std::expm1(x); });
  };
  surface.interfaces.push_back({times(even, coherent), times(odd, coherent)});
  surface.lobes.push_back(
      {.shape = std::make_shared<DiffractingShape>(rms_height, correlation_length),
       .colour = times(even, scattered),
       .shape_parameter = grid.nanometres().inverse(),
       .difference = times(odd, scattered)});
  return surface;
}

Surface coated(const WavelengthGrid& grid, const ArrayXd& base, const ArrayXd& n,
               double rms_slope) {
  expect_reflectance(base);
  expect((n > 1.0).all(), "refractive_index must be > 1", n.minCoeff());
  expect(rms_slope >= 0.0, "rms_slope must be >= 0", rms_slope);
  const ArrayXcd n_hat = n.cast<std::complex<double>>();
  Surface surface = rms_slope > 0.0 ? cook_torrance(grid, rms_slope, n_hat) : smooth(grid, n_hat);
  const double share = rms_slope > 0.0 ? transmitted_share(rms_slope, n.mean()) : 1.0;
  const ArrayXd from_outside = n.unaryExpr(&diffuse_fresnel_reflectance);
  const ArrayXd n2 = n.square();
  const ArrayXd from_inside = 1.0 - (1.0 - from_outside) / n2;
  surface.lobes.push_back({.shape = std::make_shared<TransmittedShape>(),
                           .colour = constant(share * base / (n2 * (1.0 - base * from_inside))),
                           .shape_parameter = n});
  return surface;
}

Surface mixture(const std::vector<Surface>& surfaces, const std::vector<double>& weights) {
  if (surfaces.empty() || surfaces.size() != weights.size()) {
    throw std::invalid_argument("mixture: needs one weight for each surface, and at least one");
  }
  Surface sum{.grid = surfaces.front().grid};
  double total = 0.0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double weight = weights[i];
    expect(weight >= 0.0, "a weight must be >= 0", weight);
    total += weight;
    expect(total <= 1.0 + rounding, "the sum of weights must be <= 1", total);
    const auto weighted = [weight](const Colour& colour) {
      return times(colour, [weight](double) { return weight; });
    };
    for (const Lobe& lobe : surfaces[i].lobes) {
      sum.lobes.push_back(
          {lobe.shape, weighted(lobe.colour), lobe.shape_parameter, weighted(lobe.difference)});
    }
    for (const Interface& interface : surfaces[i].interfaces) {
      sum.interfaces.push_back({weighted(interface.colour), weighted(interface.difference)});
    }
    for (const MeasuredTerm& term : surfaces[i].measured) {
      sum.measured.push_back({term.brdf, weight * term.spectra, term.warnings});
    }
  }
  return sum;
}

}  // namespace gonio

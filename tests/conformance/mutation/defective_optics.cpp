#include "tests/conformance/mutation/defective_optics.hpp"

#include <cmath>
#include <utility>

#include "emulator/integration/aperture_integrator.hpp"

namespace gonio::conformance {

namespace {

using Eigen::ArrayXd;

/// The aperture integrator, with something changed on the way in or out.
class DefectiveIntegrator : public FluxIntegrator {
 public:
  [[nodiscard]] Flux reflected(const Surface& surface, const MeasuringGeometry& geometry,
                               const ArrayXd& weight, double tolerance) const final {
    Flux flux = sound_.reflected(changed(surface), changed(geometry), weight, tolerance);
    flux.spectral = changed(flux.spectral, surface.grid);
    return flux;
  }
  [[nodiscard]] double incident(const Aperture& source) const final {
    return sound_.incident(source);
  }
  [[nodiscard]] Flux hemispherical(const Surface& surface, const Vector3& omega_i,
                                   const ArrayXd& weight, double tolerance) const final {
    return sound_.hemispherical(surface, omega_i, weight, tolerance);
  }

 private:
  [[nodiscard]] virtual Surface changed(const Surface& surface) const { return surface; }
  [[nodiscard]] virtual MeasuringGeometry changed(const MeasuringGeometry& geometry) const {
    return geometry;
  }
  [[nodiscard]] virtual ArrayXd changed(const ArrayXd& spectral, const WavelengthGrid&) const {
    return spectral;
  }

  ApertureIntegrator sound_;
};

template <Surface (*change)(const Surface&)>
std::shared_ptr<const FluxIntegrator> with_surface() {
  class Integrator final : public DefectiveIntegrator {
    [[nodiscard]] Surface changed(const Surface& surface) const override { return change(surface); }
  };
  return std::make_shared<Integrator>();
}

template <MeasuringGeometry (*change)(const MeasuringGeometry&)>
std::shared_ptr<const FluxIntegrator> with_geometry() {
  class Integrator final : public DefectiveIntegrator {
    [[nodiscard]] MeasuringGeometry changed(const MeasuringGeometry& geometry) const override {
      return change(geometry);
    }
  };
  return std::make_shared<Integrator>();
}

template <double (*change)(const ArrayXd&, const WavelengthGrid&)>
std::shared_ptr<const FluxIntegrator> with_spectrum() {
  class Integrator final : public DefectiveIntegrator {
    [[nodiscard]] ArrayXd changed(const ArrayXd& spectral,
                                  const WavelengthGrid& grid) const override {
      return ArrayXd::Constant(spectral.size(), change(spectral, grid));
    }
  };
  return std::make_shared<Integrator>();
}

/// The same surface with the colours of all its interfaces and lobes changed.
template <class Change>
Surface recoloured(Surface surface, Change change) {
  for (Interface& part : surface.interfaces) {
    part.colour = change(part.colour);
  }
  for (Lobe& lobe : surface.lobes) {
    lobe.colour = change(lobe.colour);
  }
  return surface;
}

Surface at_normal_incidence(const Surface& surface) {
  return recoloured(surface, [](const Colour& colour) -> Colour {
    return [colour](double) { return colour(1.0); };
  });
}

Surface by_amplitude(const Surface& surface) {
  return recoloured(surface, [](const Colour& colour) -> Colour {
    return [colour](double c) -> ArrayXd { return colour(c).sqrt(); };
  });
}

/// @see Schlick, Computer Graphics Forum 13, 233 (1994)
Surface by_schlick(const Surface& surface) {
  return recoloured(surface, [](const Colour& colour) -> Colour {
    return [colour](double c) -> ArrayXd {
      const ArrayXd at_normal = colour(1.0);
      return at_normal + (1.0 - at_normal) * std::pow(1.0 - c, 5);
    };
  });
}

Surface for_s_alone(const Surface& surface) { return polarised(surface, 1.0); }

Surface without_lobes(const Surface& surface) {
  return {.grid = surface.grid, .interfaces = surface.interfaces};
}

/// A shape with a factor for each reflected direction.
template <class Factor>
class ScaledShape final : public Shape {
 public:
  ScaledShape(std::shared_ptr<const Shape> sound, Factor factor)
      : sound_(std::move(sound)), factor_(factor) {}
  void evaluate(double parameter, const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<ArrayXd> g) const override {
    sound_->evaluate(parameter, omega_i, omega_r, g);
    g *= factor_(omega_r);
  }
  [[nodiscard]] SlopeWidth slope_width(double parameter, double cos_theta_d) const override {
    return sound_->slope_width(parameter, cos_theta_d);
  }

 private:
  std::shared_ptr<const Shape> sound_;
  Factor factor_;
};

template <class Factor>
Surface reshaped(Surface surface, Factor factor) {
  for (Lobe& lobe : surface.lobes) {
    lobe.shape = std::make_shared<ScaledShape<Factor>>(lobe.shape, factor);
  }
  return surface;
}

Surface without_cosine(const Surface& surface) {
  return reshaped(
      surface, [](const DirectionBatch& omega_r) -> ArrayXd { return 1.0 / omega_r.z.max(1e-9); });
}

/// As eq. (15) is printed. @see Normalization::as_printed
Surface four_times(const Surface& surface) {
  return reshaped(surface, [](const DirectionBatch& omega_r) -> ArrayXd {
    return ArrayXd::Constant(omega_r.size(), 4.0);
  });
}

Aperture resized(const Aperture& aperture, double u_factor, double v_factor) {
  return Aperture::face(aperture.frame(), u_factor * aperture.u_low(), u_factor * aperture.u_high(),
                        v_factor * aperture.v_low(), v_factor * aperture.v_high());
}

MeasuringGeometry half_angle_as_full(const MeasuringGeometry& geometry) {
  return {geometry.source, resized(geometry.receptor, 0.5, 0.5)};
}

MeasuringGeometry full_angle_as_half(const MeasuringGeometry& geometry) {
  return {geometry.source, resized(geometry.receptor, 2.0, 2.0)};
}

MeasuringGeometry receptor_on_its_side(const MeasuringGeometry& geometry) {
  const Aperture& r = geometry.receptor;
  return {geometry.source, Aperture::face(r.frame(), r.v_low(), r.v_high(), r.u_low(), r.u_high())};
}

MeasuringGeometry receptor_turned_away(const MeasuringGeometry& geometry) {
  const Aperture& r = geometry.receptor;
  return {geometry.source, r.seen_by_tilted(degrees(0.5))};
}

/// One line of a lamp in place of all its light.
double at_555_nm(const ArrayXd& spectral, const WavelengthGrid& grid) {
  Eigen::Index nearest = 0;
  (grid.nanometres() - 555.0).abs().minCoeff(&nearest);
  return spectral[nearest];
}

double unweighted(const ArrayXd& spectral, const WavelengthGrid&) { return spectral.mean(); }

}  // namespace

const std::map<std::string, OpticsDefect>& optics_defects() {
  static const std::map<std::string, OpticsDefect> all{
      {"fresnel_at_normal_incidence", with_surface<at_normal_incidence>},
      {"amplitude_for_reflectance", with_surface<by_amplitude>},
      {"schlick_for_fresnel", with_surface<by_schlick>},
      {"s_polarisation_alone", with_surface<for_s_alone>},
      {"lobes_missing", with_surface<without_lobes>},
      {"cosine_missing", with_surface<without_cosine>},
      {"factor_4_missing", with_surface<four_times>},
      {"half_angle_as_full", with_geometry<half_angle_as_full>},
      {"full_angle_as_half", with_geometry<full_angle_as_half>},
      {"receptor_on_its_side", with_geometry<receptor_on_its_side>},
      {"receptor_turned_away", with_geometry<receptor_turned_away>},
      {"one_wavelength", with_spectrum<at_555_nm>},
      {"wavelengths_unweighted", with_spectrum<unweighted>}};
  return all;
}

}  // namespace gonio::conformance

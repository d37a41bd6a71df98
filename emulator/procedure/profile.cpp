#include "emulator/procedure/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Asked of each element, relative to the incident flux: a millionth of what a glass reflects.
constexpr double element_tolerance = 5e-8;

ArrayXd edges_of(const ProfileSetup& setup) {
  constexpr double most_elements = 20'000.0;
  const double half_count = std::round(setup.reach.radians() / setup.step.radians());
  if (!(half_count >= 1.0 && 2.0 * half_count <= most_elements)) {
    throw std::domain_error(fmt::format("profile: expected 2 to {:g} elements, found {:g}",
                                        most_elements, 2.0 * half_count));
  }
  const double reach = half_count * setup.step.radians();
  if (!(setup.theta_i.radians() + reach < 0.5 * std::numbers::pi)) {
    throw std::domain_error(
        fmt::format("profile: expected a row that ends before 90 deg, found one up to {:.4g} deg",
                    setup.theta_i.degrees() + radians(reach).degrees()));
  }
  return ArrayXd::LinSpaced(Index(2.0 * half_count) + 1, -reach, reach);
}

}  // namespace

double Profile::between(double low_rad, double high_rad) const {
  double sum = 0.0;
  for (Index k = 0; k < flux.size(); ++k) {
    const double width = edge_rad(k + 1) - edge_rad(k);
    const double common = std::min(high_rad, edge_rad(k + 1)) - std::max(low_rad, edge_rad(k));
    sum += common > 0.0 ? flux(k) * std::min(common / width, 1.0) : 0.0;
  }
  return sum;
}

bool Profile::covers(double low_rad, double high_rad) const {
  constexpr double rounding = 1e-12;
  return low_rad >= edge_rad(0) - rounding && high_rad <= edge_rad(edge_rad.size() - 1) + rounding;
}

ProfileScale profile_scale(const Standard& standard, const WavelengthGrid& grid) {
  if (!standard.scale.refractive_index) {
    throw std::invalid_argument(
        fmt::format("expected a standard with a reference glass, found '{}'", standard.id));
  }
  const ArrayXd weight = standard.source.sample(grid) * standard.responsivity.sample(grid);
  return {.weight = weight / weight.sum(),
          .reference = smooth(grid, Eigen::ArrayXcd::Constant(
                                        grid.size(), standard.scale.refractive_index->nominal))};
}

Profile measure_profile(const Surface& surface, const ProfileSetup& setup, const ArrayXd& weight,
                        const FluxIntegrator& integrator, Angle tilt) {
  Profile profile{.edge_rad = edges_of(setup)};
  const Index count = profile.edge_rad.size() - 1;
  profile.flux = ArrayXd::Zero(count);
  const Aperture source = Aperture::rectangle(source_frame(setup.theta_i), setup.source_in_plane,
                                              setup.source_perpendicular)
                              .seen_by_tilted(tilt);
  const Frame frame = receptor_frame(setup.theta_i);
  const double half_width = std::tan(0.5 * setup.receptor_perpendicular.radians());
  const double incident = integrator.incident(source);
  parallel_for(std::size_t(count), [&](std::size_t i) {
    const auto k = Index(i);
    const Aperture element =
        Aperture::face(frame, std::tan(profile.edge_rad(k)), std::tan(profile.edge_rad(k + 1)),
                       -half_width, half_width)
            .seen_by_tilted(tilt);
    const Flux flux = integrator.reflected(surface, {.source = source, .receptor = element}, weight,
                                           element_tolerance * incident);
    profile.flux(k) = (weight * flux.spectral).sum() / incident;
  });
  return profile;
}

}  // namespace gonio

#include "emulator/goniometry/fit_observations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// A grid that holds all wavelengths of all spectra: theirs, if those are equally spaced.
WavelengthGrid grid_of(const std::vector<ReflectanceSpectrum>& spectra) {
  std::vector<double> all;
  for (const ReflectanceSpectrum& spectrum : spectra) {
    all.insert(all.end(), spectrum.wavelength_nm.begin(), spectrum.wavelength_nm.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const double first = all.front(), span = all.back() - first;
  if (!(span > 0.0)) {
    return {nanometres(first), nanometres(1.0), 1};
  }
  constexpr double exact = 1e-9, finest_nm = 1.0;
  double step = span / double(all.size() - 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(all[i] - (first + double(i) * step)) > exact) {
      step = span / std::ceil(span / finest_nm);
      break;
    }
  }
  const auto steps = Index(std::lround(span / step));
  // The last may not pass that of the spectra, where data of the material may end.
  while (first + step * double(steps) > all.back()) {
    step = std::nextafter(step, 0.0);
  }
  return {nanometres(first), nanometres(step), steps + 1};
}

/// A spectrum on a grid, linear between its points.
ArrayXd interpolated(const ArrayXd& values, const WavelengthGrid& grid, const ArrayXd& at_nm) {
  const ArrayXd& x = grid.nanometres();
  ArrayXd result(at_nm.size());
  for (Index j = 0; j < at_nm.size(); ++j) {
    const Index above = std::clamp<Index>(
        std::lower_bound(x.begin(), x.end(), at_nm(j)) - x.begin(), 0, x.size() - 1);
    const Index below = std::max<Index>(above - 1, 0);
    const double step = x(above) - x(below);
    const double t = step > 0.0 ? std::clamp((at_nm(j) - x(below)) / step, 0.0, 1.0) : 0.0;
    result(j) = (1.0 - t) * values(below) + t * values(above);
  }
  return result;
}

/// One geometry of the virtual instrument, relative to a perfect mirror.
struct MirrorRelative {
  std::string id;
  MeasuringGeometry geometry;
  double polarization = 0.0;
  double incident = 0.0;
  double mirror = 0.0;  ///< flux of the mirror
  ArrayXd wavelength_nm;

  [[nodiscard]] VectorXd reflectance(const Surface& surface) const {
    // A bound, which the error keeps far below; the noise of a good spectrometer is a hundred times
    // as much.
    constexpr double relative_tolerance = 1e-5;
    const ArrayXd weight =
        ArrayXd::Constant(surface.grid.size(), 1.0 / double(surface.grid.size()));
    const Flux flux = ApertureIntegrator().reflected(
        polarization == 0.0 ? surface : polarised(surface, polarization), geometry, weight,
        relative_tolerance * incident);
    return interpolated(flux.spectral / mirror, surface.grid, wavelength_nm);
  }
};

MirrorRelative relative_to_mirror(const Instrument& instrument,
                                  const ReflectanceSpectrum& spectrum) {
  if (!instrument.has(spectrum.geometry)) {
    throw InputError(spectrum.mark,
                     fmt::format("a geometry of {}, one of {}", instrument.id,
                                 fmt::join(instrument.geometries, ", ")),
                     spectrum.geometry);
  }
  const auto found = instrument.polarization.find(spectrum.geometry);
  MirrorRelative made{.id = spectrum.geometry,
                      .geometry = instrument.geometry(spectrum.geometry),
                      .polarization = found == instrument.polarization.end() ? 0.0 : found->second,
                      .wavelength_nm = spectrum.wavelength_nm};
  const ApertureIntegrator integrator;
  constexpr double mirror_tolerance = 1e-13;
  made.incident = integrator.incident(made.geometry.source);
  const WavelengthGrid one(nanometres(spectrum.wavelength_nm(0)), nanometres(1.0), 1);
  made.mirror = integrator
                    .reflected(smooth(one, 1.0), made.geometry, ArrayXd::Ones(1),
                               mirror_tolerance * made.incident)
                    .spectral(0);
  if (!(made.mirror > 0.0)) {
    throw InputError(spectrum.mark, "a geometry in which a mirror reflects into the receptor",
                     spectrum.geometry);
  }
  return made;
}

}  // namespace

FitObservations observations_of(const std::vector<ReflectanceSpectrum>& spectra,
                                const Instrument& instrument) {
  if (spectra.empty()) {
    throw std::invalid_argument("a fit needs a spectrum");
  }
  FitObservations made{
      .quantity = "reflectance relative to a perfect mirror",
      .abscissa = "wavelength / nm",
      .weighting = "differences count by their standard uncertainty",
      .grid = grid_of(spectra),
      .is_u_known = std::ranges::all_of(spectra, [](const auto& s) { return s.u.size() > 0; })};
  if (!made.is_u_known) {
    made.weighting = "all differences count alike";
  }
  Index n = 0;
  const auto benches = std::make_shared<std::vector<MirrorRelative>>();
  for (const ReflectanceSpectrum& spectrum : spectra) {
    benches->push_back(relative_to_mirror(instrument, spectrum));
    made.groups.push_back(
        {.id = spectrum.geometry, .first = n, .abscissa = spectrum.wavelength_nm});
    n += spectrum.reflectance.size();
    made.observed.conservativeResize(n);
    made.u.conservativeResize(n);
    made.observed.tail(spectrum.reflectance.size()) = spectrum.reflectance;
    made.u.tail(spectrum.reflectance.size()) =
        made.is_u_known ? spectrum.u : ArrayXd::Ones(spectrum.reflectance.size());
  }
  made.respond = [benches, n](const Surface& surface) {
    std::vector<VectorXd> parts(benches->size());
    parallel_for(parts.size(),
                 [&](std::size_t i) { parts[i] = (*benches)[i].reflectance(surface); });
    VectorXd response(n);
    Index first = 0;
    for (const VectorXd& part : parts) {
      response.segment(first, part.size()) = part;
      first += part.size();
    }
    return response;
  };
  return made;
}

}  // namespace gonio

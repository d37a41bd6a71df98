#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/goniometry/fit_observations.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "emulator/surface/models.hpp"

namespace gonio::test {

/// Spectra of a material as the instrument of the paper measures them at 20, 60 and 85 deg.
struct FitSpectra {
  /// @param index  of the material, a file below fixtures/nk.
  explicit FitSpectra(const std::string& index)
      : n_hat(RefractiveIndex::load(Catalog({GONIO_SOURCE_DIR}).fixture("nk/" + index))
                  .sample(grid)) {}

  /// Without noise, and without uncertainties.
  [[nodiscard]] std::vector<ReflectanceSpectrum> exact(const Surface& surface) const {
    std::vector<ReflectanceSpectrum> spectra;
    for (const std::string& id : instrument.geometries) {
      spectra.push_back({.geometry = id,
                         .wavelength_nm = grid.nanometres(),
                         .reflectance = Eigen::ArrayXd::Zero(grid.size()),
                         .mark = {}});
    }
    const Eigen::VectorXd response = observations_of(spectra, instrument).respond(surface);
    for (std::size_t g = 0; g < spectra.size(); ++g) {
      spectra[g].reflectance = response.segment(Eigen::Index(g) * grid.size(), grid.size());
    }
    return spectra;
  }
  /// With normal noise, in proportion to the largest reflectance of each spectrum.
  template <class Random>
  [[nodiscard]] std::vector<ReflectanceSpectrum> with_noise(
      std::vector<ReflectanceSpectrum> spectra, double noise_to_signal, Random& random) const {
    std::normal_distribution<double> normal;
    for (ReflectanceSpectrum& spectrum : spectra) {
      const double u = noise_to_signal * spectrum.reflectance.maxCoeff();
      spectrum.u = Eigen::ArrayXd::Constant(grid.size(), u);
      for (double& value : spectrum.reflectance) {
        value += u * normal(random);
      }
    }
    return spectra;
  }
  template <class Random>
  [[nodiscard]] std::vector<ReflectanceSpectrum> measured(const Surface& surface,
                                                          double noise_to_signal,
                                                          Random& random) const {
    return with_noise(exact(surface), noise_to_signal, random);
  }

  WavelengthGrid grid = WavelengthGrid::visible();
  Eigen::ArrayXcd n_hat;
  Catalog catalog{{GONIO_SOURCE_DIR}};
  Instrument instrument =
      load_instrument(catalog.find(Catalog::Kind::instrument, "paper_setup"), catalog);
};

}  // namespace gonio::test

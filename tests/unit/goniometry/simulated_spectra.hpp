#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emulator/goniometry/setup_calibration.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/uncertainty/random.hpp"
#include "tests/unit/procedure/responses.hpp"

// Spectra that a planted set-up would give, for what goes back from spectra to a set-up.

namespace gonio::test {

/// The dynamic range of the spectrometer of [Mihalik], section 6, taken as signal to noise.
constexpr double signal_to_noise = 900.0;

inline SampleFamily family(const std::filesystem::path& file) {
  return SampleFamily::load(file, WavelengthGrid(nanometres(400), nanometres(20), 16));
}
inline SampleFamily shipped_family(const std::string& id) {
  return family(shipped().find(Catalog::Kind::sample, id));
}

inline CalibrationSpectrum unmeasured(SampleFamily sample, const std::string& geometry) {
  const Eigen::ArrayXd lambda = Eigen::ArrayXd::LinSpaced(16, 400.0, 700.0);
  return {.sample = std::move(sample),
          .spectrum = {.geometry = geometry,
                       .wavelength_nm = lambda,
                       .reflectance = Eigen::ArrayXd::Zero(lambda.size())}};
}

/// A set-up to be found: the instrument as it is assumed to be, and spectra without values.
struct Unknown {
  Instrument instrument;
  std::vector<CalibrationSpectrum> spectra;
  std::vector<std::string> free;
  MirrorReference reference = MirrorReference::source;

  [[nodiscard]] std::vector<std::string> geometries() const {
    std::vector<std::string> ids;
    for (const CalibrationSpectrum& one : spectra) {
      if (std::ranges::find(ids, one.spectrum.geometry) == ids.end()) {
        ids.push_back(one.spectrum.geometry);
      }
    }
    return ids;
  }
  [[nodiscard]] SetupModel model() const { return model(spectra); }
  [[nodiscard]] SetupModel model(std::vector<CalibrationSpectrum> with) const {
    return {instrument, std::move(with), setup_parameters(instrument, geometries(), free),
            reference, std::make_shared<ApertureIntegrator>()};
  }
  /// With the spectra of a planted set-up and its noise.
  /// @param states_u  whether the spectra tell their uncertainty; if not, it is one for all.
  [[nodiscard]] SetupModel measured(const Eigen::VectorXd& simulated, std::uint64_t seed,
                                    std::uint64_t trial, bool states_u = true) const {
    Eigen::VectorXd noise(simulated.size());
    Draws(seed, trial).normal({noise.data(), std::size_t(noise.size())});
    std::vector<CalibrationSpectrum> with = spectra;
    Eigen::Index begin = 0;
    for (CalibrationSpectrum& one : with) {
      const Eigen::Index n = one.spectrum.wavelength_nm.size();
      const Eigen::ArrayXd exact = simulated.segment(begin, n);
      const Eigen::ArrayXd signal =
          states_u ? exact : Eigen::ArrayXd::Constant(n, simulated.maxCoeff());
      const Eigen::ArrayXd u = signal / signal_to_noise;
      one.spectrum.reflectance = exact + u * noise.segment(begin, n).array();
      if (states_u) {
        one.spectrum.u = u;
      }
      begin += n;
    }
    return model(std::move(with));
  }
};

inline Instrument with_diameter(Instrument instrument, const std::vector<std::string>& geometries,
                                SetupQuantity quantity, double value_deg) {
  for (const std::string& geometry : geometries) {
    instrument =
        with_quantity(std::move(instrument), geometry, quantity, {.value = degrees(value_deg)});
  }
  return instrument;
}

}  // namespace gonio::test

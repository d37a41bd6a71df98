#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/goniometry/reflectance_spectrum.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/measured/brdf_samples.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// Observations that belong together: a spectrum, or what one direction of incidence gives.
struct FitGroup {
  std::string id;
  Eigen::Index first = 0;        ///< of its observations
  Eigen::ArrayXd abscissa = {};  ///< of each of them, shape (n of the group)

  [[nodiscard]] Eigen::Index size() const { return abscissa.size(); }
};

/// What reflection models are fitted to.
struct FitObservations {
  std::string file = {};                            ///< where they come from
  std::string quantity = {};                        ///< what was observed
  std::string abscissa = {};                        ///< what it stands over
  std::string weighting = {};                       ///< what a difference counts, in words
  WavelengthGrid grid = WavelengthGrid::visible();  ///< that surfaces are to have
  std::vector<FitGroup> groups = {};
  Eigen::VectorXd observed = {};  ///< shape (n)
  /// Standard uncertainties, > 0, shape (n); if they are not known, what they are in proportion to.
  Eigen::VectorXd u = {};
  bool is_u_known = false;
  /// What would be observed of a surface on the grid, shape (n): linear in its BRDF. May be called
  /// from several threads.
  std::function<Eigen::VectorXd(const Surface&)> respond = {};
};

/// Spectra relative to a perfect mirror, compared with what reaches the receptor through the
/// apertures of an instrument. @see [Mihalik] eq. (16), section 8
/// @throws InputError  for a geometry that the instrument does not have.
[[nodiscard]] FitObservations observations_of(const std::vector<ReflectanceSpectrum>& spectra,
                                              const Instrument& instrument);

/// A BRDF at directions. A relative difference counts by the root of cos theta_i cos theta_r, so
/// that neither the peak of a lobe nor grazing directions decide alone; what is darker than a
/// hundredth of the mean counts as if it were as bright.
/// Of wavelengths all are compared; of bands the luminance, at 555 nm.
/// @throws std::invalid_argument  if it holds no direction above the surface.
[[nodiscard]] FitObservations observations_of(const BrdfSamples& samples);

/// Directions at which a measured BRDF shows its lobes: six incidences, and half vectors that
/// stand closer round the normal.
[[nodiscard]] BrdfSamples sampled_for_fit(const MeasuredBrdf& brdf);

}  // namespace gonio

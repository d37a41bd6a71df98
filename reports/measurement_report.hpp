#pragma once

#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/procedure/footprint.hpp"
#include "emulator/procedure/measure.hpp"

namespace gonio {

/// How measurements were made: what stands above their table.
struct MeasurementHeader {
  const Standard& standard;
  std::string instrument;  ///< title
  std::string integrator;  ///< aperture or patches
  std::string reference;   ///< what the scale refers to, in words
  WavelengthGrid grid;
};

/// A table for people: values rounded as the standard says beside the computed ones.
/// @param styled  marks the selected geometry in bold, for a terminal.
[[nodiscard]] std::string measurement_text(const MeasurementHeader& header,
                                           const std::vector<Measurement>& measurements,
                                           bool styled);

/// Schema gonio/measurement/1, numbers at full precision; several samples stand in the list
/// `measurements` of schema gonio/measurements/1.
[[nodiscard]] std::string measurement_json(const MeasurementHeader& header,
                                           const std::vector<Measurement>& measurements);

/// One row for each sample and geometry, numbers at full precision.
[[nodiscard]] std::string measurement_csv(const MeasurementHeader& header,
                                          const std::vector<Measurement>& measurements);

/// Spectral reflectance: a row for each wavelength, a column for each sample and geometry.
[[nodiscard]] std::string spectra_csv(const MeasurementHeader& header,
                                      const std::vector<Measurement>& measurements);

/// A page of its own: readings, spectra and what the receptors see; charts inside, no network
/// needed.
/// @param footprints  of each sample, those that there are, shape (n_measurements, any).
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string measurement_page(const MeasurementHeader& header,
                                           const std::vector<Measurement>& measurements,
                                           const std::vector<std::vector<Footprint>>& footprints);

}  // namespace gonio

#pragma once

#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/procedure/measure_colour.hpp"

namespace gonio {

/// How colours were measured: what stands above their table.
struct ColourHeader {
  const Instrument& instrument;
  const ColourConditions& conditions;
  WavelengthGrid grid;
};

/// A table for people.
[[nodiscard]] std::string colour_text(const ColourHeader& header,
                                      const std::vector<ColourMeasurement>& measurements,
                                      bool styled);

/// Schema gonio/colour/1, numbers at full precision.
[[nodiscard]] std::string colour_json(const ColourHeader& header,
                                      const std::vector<ColourMeasurement>& measurements);

/// One row for each sample and geometry, numbers at full precision.
[[nodiscard]] std::string colour_csv(const ColourHeader& header,
                                     const std::vector<ColourMeasurement>& measurements);

/// Radiance factors: a row for each wavelength, a column for each sample and geometry.
[[nodiscard]] std::string radiance_factor_csv(const ColourHeader& header,
                                              const std::vector<ColourMeasurement>& measurements);

/// A page of its own, with the radiance factors as charts.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string colour_page(const ColourHeader& header,
                                      const std::vector<ColourMeasurement>& measurements);

}  // namespace gonio

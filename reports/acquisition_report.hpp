#pragma once

#include <string>

#include "emulator/goniometry/acquisition.hpp"

namespace gonio {

/// For a terminal: a row for each spectrum, and what a reader must know of it.
[[nodiscard]] std::string acquisition_text(const AcquisitionResult& result, bool styled);
/// Schema gonio/acquired_spectra/1: everything, numbers at full precision.
[[nodiscard]] std::string acquisition_json(const AcquisitionResult& result);
/// What load_reflectance_spectra reads.
[[nodiscard]] std::string acquisition_csv(const AcquisitionResult& result);
/// A page of its own: the spectra with their uncertainty; charts inside, no network needed.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string acquisition_page(const AcquisitionResult& result,
                                           const std::string& version);

}  // namespace gonio

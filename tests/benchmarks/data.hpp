#pragma once

#include <memory>
#include <string>

#include "emulator/core/catalog.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/sample.hpp"

// The data of the source tree that benchmarks run on.

namespace gonio::bench {

inline Catalog catalog() { return Catalog({GONIO_SOURCE_DIR}); }

inline Sample sample(const std::string& id, const WavelengthGrid& grid) {
  return load_sample(catalog().find(Catalog::Kind::sample, id), grid);
}

/// The glossmeter of ISO 2813 as the standard has it: 20, 60 and 85 deg, both apertures.
inline Glossmeter nominal_glossmeter(const WavelengthGrid& grid) {
  const Standard standard = load_standard(catalog().find(Catalog::Kind::standard, "iso_2813/2014"));
  return {nominal_instrument(standard), grid, std::make_shared<ApertureIntegrator>()};
}

/// One wavelength in the middle of the visible range.
inline WavelengthGrid one_wavelength() { return {nanometres(555), nanometres(5), 1}; }

}  // namespace gonio::bench

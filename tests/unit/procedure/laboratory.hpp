#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/procedure/measure.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio::test {

/// The visible range in 81 wavelengths.
inline const WavelengthGrid visible = WavelengthGrid::visible();

inline Observer observer() {
  return Observer::load(shipped().fixture("observers/cie_1931_2deg.csv"), visible);
}

inline Glossmeter meter_of(const Instrument& instrument) {
  return {instrument, visible, std::make_shared<ApertureIntegrator>()};
}
inline Glossmeter meter_by_standard(const std::string& id) {
  return meter_of(nominal_instrument(shipped_standard(id)));
}
inline Glossmeter shipped_meter(const std::string& id) {
  return meter_of(load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped()));
}

inline Sample shipped_sample(const std::string& id) {
  return load_sample(shipped().find(Catalog::Kind::sample, id), visible);
}

/// A sample by the text of its `surface:`, written to `folder` first.
inline Sample sample_of(const std::filesystem::path& file, const std::string& surface) {
  std::ofstream(file) << "schema: gonio/sample/1\nid: mine\ntitle: Mine\nsurface: " << surface
                      << "\n";
  return load_sample(file, visible);
}

}  // namespace gonio::test

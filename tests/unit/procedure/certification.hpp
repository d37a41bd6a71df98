#pragma once

#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/overlay.hpp"
#include "emulator/procedure/certify.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio::test {

/// Few wavelengths: set-ups are judged by geometry.
inline const WavelengthGrid coarse(nanometres(400.0), nanometres(50.0), 7);

inline ClauseSet clauses_of(const std::string& id) {
  return load_clauses(shipped().find(Catalog::Kind::clauses, id), shipped());
}

/// The shipped instrument with some keys laid over it.
inline Instrument triangle_gloss(const std::string& overlay = "{}") {
  const Instrument instrument =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  return with_overlay(instrument, YamlNode::parse(overlay, "overlay"), shipped());
}

/// Some samples of the ladder, in the order of `ids`.
inline std::vector<Sample> rungs(const std::vector<std::string>& ids,
                                 const WavelengthGrid& grid = coarse) {
  std::vector<Sample> chosen;
  for (const std::string& id : ids) {
    for (Sample& sample : effect_ladder(grid)) {
      if (sample.id == id) {
        chosen.push_back(std::move(sample));
      }
    }
  }
  return chosen;
}

/// Only normal distributions, and small ones.
inline const std::string all_normal =
    "{setup_uncertainty: {angles: 0.01 deg, apertures: 0.01 deg}, uncertainty: {"
    "reference_index: {standard_uncertainty: 0.0005},"
    "reference_value: {standard_uncertainty: 0.1 GU},"
    "polarization: {standard_uncertainty: 0.002},"
    "spectral_mismatch: {standard_uncertainty: 0.01},"
    "linearity: {standard_uncertainty: 0.0001},"
    "zero: {standard_uncertainty: 0.03 GU},"
    "drift: {standard_uncertainty: 0.0005},"
    "temperature: {standard_uncertainty: 1 K},"
    "resolution: {standard_uncertainty: 0.03 GU},"
    "repeatability: {standard_uncertainty: 0.05 GU}}}";

}  // namespace gonio::test

#pragma once

#include "emulator/core/catalog.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/instrument.hpp"

namespace gonio {

/// The same instrument with deviations laid over it: the keys `as_built`, `setup_uncertainty`,
/// `uncertainty`, `polarization`, `spot`, `source_spectrum`, `responsivity`, `repeatability`,
/// `behaviour` and `samples` of an instrument file. What the overlay states takes the place of what
/// was there, number by number (a list or a spectrum as a whole); the rest stays.
/// @param overlay  a map; files in it are relative to its own file.
/// @param catalog  where `samples` are looked up.
/// @throws InputError  at the place in the overlay's file for anything that is not as the schema
///                     of instruments says, and for any other key.
[[nodiscard]] Instrument with_overlay(Instrument instrument, const YamlNode& overlay,
                                      const Catalog& catalog);

/// Reads these keys from a map that may have others, as an instrument file has.
void read_overlay(YamlMap& map, Instrument& instrument, const Catalog& catalog);

}  // namespace gonio

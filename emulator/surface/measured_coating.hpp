#pragma once

#include "emulator/surface/coating.hpp"

namespace gonio {

/// The model `measured` of a sample file: the BRDF of another file, which has no parameters to
/// deviate.
/// @throws InputError  for anything that is not as the schema of samples says, and by load_brdf.
[[nodiscard]] Coating read_measured(YamlMap& map, const WavelengthGrid& grid);

}  // namespace gonio

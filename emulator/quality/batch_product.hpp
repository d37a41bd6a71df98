#pragma once

#include "emulator/core/catalog.hpp"
#include "emulator/quality/batch.hpp"

namespace gonio {

/// Reads the map `product` of a batch file.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Product read_product(const YamlNode& node, const Catalog& catalog);

}  // namespace gonio

#pragma once

#include <map>
#include <memory>
#include <string>

#include "emulator/integration/flux.hpp"

namespace gonio::conformance {

/// An integrator with wrong physics.
using OpticsDefect = std::shared_ptr<const FluxIntegrator> (*)();

/// All of them by name, e.g. cosine_missing.
[[nodiscard]] const std::map<std::string, OpticsDefect>& optics_defects();

}  // namespace gonio::conformance

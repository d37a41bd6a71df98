#pragma once

#include <string>

#include "emulator/measured/brdf_summary.hpp"

namespace gonio {

/// What a measured BRDF is, for people. Of many channels some stand for all.
[[nodiscard]] std::string brdf_text(const BrdfSummary& summary);

/// Schema gonio/brdf/1, numbers at full precision.
[[nodiscard]] std::string brdf_json(const BrdfSummary& summary);

}  // namespace gonio

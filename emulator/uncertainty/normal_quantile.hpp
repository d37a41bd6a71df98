#pragma once

#include <span>

namespace gonio {

/// Replaces each p by the quantile of the standard normal distribution at p, to 2e-15 relative.
/// @param values  in (0, 1).
/// @see Wichura, Algorithm AS 241: the percentage points of the normal distribution, 1988, PPND16
void to_normal_quantile(std::span<double> values);

}  // namespace gonio

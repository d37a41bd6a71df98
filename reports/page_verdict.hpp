#pragma once

#include "emulator/standard/decision.hpp"
#include "reports/page.hpp"

namespace gonio {

/// A verdict with its words and its symbol, which one sees without colours too.
[[nodiscard]] PageData verdict_data(ConformanceVerdict verdict);

}  // namespace gonio

#pragma once

#include <optional>

#include "emulator/standard/decision.hpp"
#include "tests/conformance/case.hpp"

namespace gonio::conformance {

/// Holds what was found against what must be found: by the case itself where it says so, else by
/// the limit of its clause.
/// @return  nothing if the case expects nothing of that geometry.
/// @throws InputError  if neither the case nor the clause states a limit.
[[nodiscard]] std::optional<Observation> judge(const Finding& finding, const Case& stated,
                                               const Clause& clause, const ClauseSet& set,
                                               DecisionRule rule);

}  // namespace gonio::conformance

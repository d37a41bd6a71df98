#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "emulator/quality/records.hpp"

namespace gonio {

/// Computes panels on all cores and hands them over in order: while one chunk is handed over, the
/// next is computed, so that no more than two are in memory.
/// @param first, last  numbers of panels; none if first > last.
/// @param compute      called from several threads, in no order.
/// @param take         called with one chunk after another, one at a time; what it throws ends the
///                     work.
/// @param chunk        panels, > 0.
void compute_panels(std::uint64_t first, std::uint64_t last,
                    const std::function<PanelRecord(std::uint64_t)>& compute,
                    const std::function<void(std::span<const PanelRecord>)>& take,
                    std::uint64_t chunk = 512);

}  // namespace gonio

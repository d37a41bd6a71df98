#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/measured/brdf_points.hpp"
#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// The way between points that fits how they lie: slices on grids, the plane of incidence alone, or
/// scattered.
/// @param warnings  gets what was made the best of.
[[nodiscard]] std::unique_ptr<const MeasuredBrdf> make_brdf_interpolation(
    const BrdfPoints& points, const std::vector<BrdfChannel>& channels,
    std::vector<std::string>& warnings);

}  // namespace gonio

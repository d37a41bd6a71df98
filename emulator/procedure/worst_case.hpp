#pragma once

#include <vector>

#include "emulator/procedure/certificate.hpp"
#include "emulator/procedure/optical_response.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio {

/// How far readings may be off by set-ups that meet a standard, by sample.
struct WorstCases {
  std::vector<WorstCase> lowest = {}, highest = {};
};

/// The set-ups within the limits that read lowest and highest: of all combinations of low, nominal
/// and high of each quantity that the standard limits, with the tile read through the same set-up,
/// and changes from what the nominal set-up reads.
///
/// A polynomial tells where to look, and the optics read its best candidates, so that each change
/// is exactly that of its set-up. Where a polynomial will not do, since a mirror's image is
/// clipped, the optics read all combinations. A quantity that makes no difference to a sample is
/// nominal.
///
/// Spectra and polarization are as the standard says, quantities without a tolerance as in
/// `response.nominal()`.
/// @param limits  of the geometry of the response.
[[nodiscard]] WorstCases worst_cases(const OpticalResponse& response, const GeometryLimits& limits);

}  // namespace gonio

#pragma once

#include <string>

#include "emulator/goniometry/scan.hpp"
#include "emulator/measured/brdf_samples.hpp"

namespace gonio {

/// "circle 4.7 deg", "rectangle 0.75 deg x 2.5 deg" or "collimated".
[[nodiscard]] std::string opening_words(const ScanOpening& opening);
/// "aperture" or "patches, 196608 on the hemisphere".
[[nodiscard]] std::string integrator_words(const ScanPlan& plan);
/// Solid angle of an opening where it faces the sample, not its projection [sr].
[[nodiscard]] double solid_angle(const ScanOpening& opening);

/// A scan as other programs read it: the positions that are not blocked, in its order, with how it
/// was done in the notes.
[[nodiscard]] BrdfSamples brdf_samples(const ScanResult& result, const ScanPlan& plan,
                                       const std::string& sample_id);

}  // namespace gonio

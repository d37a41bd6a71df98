#pragma once

#include <string>
#include <vector>

#include "emulator/instrument/glossmeter.hpp"

// What is to be said of a reading that rests on a measured BRDF.

namespace gonio {

/// How much the steps of its measured terms may have changed a reading [GU]: what it changes when
/// they are blurred once more as linear interpolation over their step blurs. 0 without such terms.
///
/// Of lobes of Cook-Torrance of rms slopes 0.02 to 0.2, at steps of 1 and 5 deg, the true error at
/// 20 and 60 deg was at most twice as large. Not so at 85 deg, where f_r rises and breaks off at
/// the horizon within a step: there it was up to 30 times as large.
/// @param reading  of the same surface, geometry and tilt.
[[nodiscard]] double resolution_error_gu(const Surface& surface, const Glossmeter& glossmeter,
                                         const std::string& geometry_id,
                                         const GlossReading& reading, Angle tilt = {});

/// What the files of measured terms do not keep to, and wavelengths that they do not cover.
[[nodiscard]] std::vector<std::string> data_warnings(const Surface& surface);

/// Of one geometry: a table too coarse for its lobe, with the estimate of the error of the gloss,
/// and directions that were not measured.
[[nodiscard]] std::vector<std::string> reading_warnings(const Surface& surface,
                                                        const Glossmeter& glossmeter,
                                                        const std::string& geometry_id,
                                                        const GlossReading& reading,
                                                        Angle tilt = {});

}  // namespace gonio

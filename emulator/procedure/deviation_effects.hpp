#pragma once

#include <vector>

#include "emulator/procedure/certificate.hpp"
#include "emulator/procedure/measurement_equation.hpp"
#include "emulator/procedure/optical_response.hpp"

namespace gonio {

/// What each deviation of a geometry does to readings, all else as the standard says; and, as the
/// last one, all together.
///
/// Deviations of angles and openings, with the effect of their limits; of polarisation and of the
/// spectra; of the linearity of the detector; and of the gloss that the tile has lost since its
/// value was assigned.
/// @param limits  of that geometry.
[[nodiscard]] std::vector<DeviationEffect> deviation_effects(const Instrument& instrument,
                                                             const GeometryLimits& limits,
                                                             const OpticalResponse& optics,
                                                             const MeasurementEquation& equation);

}  // namespace gonio

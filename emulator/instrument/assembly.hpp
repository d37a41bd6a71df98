#pragma once

#include <memory>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// Builds the device of an instrument: all that needs the optical core is computed here, once per
/// sample and channel, so that a measurement later only varies it.
///
/// @param glossmeter  of the instrument as built.
/// @param behaviour   usually instrument.behaviour, or its ideal().
/// @param tolerance   asked of the integrator, in GU.
/// @throws InputError  for an aperture of unknown size.
[[nodiscard]] Device assemble_device(const Glossmeter& glossmeter, Behaviour behaviour,
                                     const std::vector<Sample>& samples, double tolerance);

}  // namespace gonio

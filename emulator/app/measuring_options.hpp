#pragma once

#include <string>

#include "emulator/core/angle.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/wavelength_grid.hpp"

// What commands that measure read from the command line alike. All throw std::invalid_argument
// that names the option.

namespace gonio::app {

/// `first:last:step` in nm, of the option --wavelengths.
[[nodiscard]] WavelengthGrid parse_wavelengths(const std::string& text);

/// @param range_deg  closed.
[[nodiscard]] Angle parse_angle(const std::string& option, const std::string& text,
                                const Range& range_deg);
/// @return mm. @param range_mm  of what is allowed.
[[nodiscard]] double parse_millimetres(const std::string& option, const std::string& text,
                                       const Range& range_mm);

/// Of --tilt.
[[nodiscard]] inline Range tilt_range() { return Range::closed(-45.0, 45.0); }

}  // namespace gonio::app

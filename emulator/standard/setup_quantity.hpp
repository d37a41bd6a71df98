#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "emulator/core/angle.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio {

/// The quantities of one geometry that a standard limits.
enum class SetupQuantity {
  theta_i,
  theta_r,
  source_in_plane,
  source_perpendicular,
  source_diameter,
  receptor_in_plane,
  receptor_perpendicular,
  receptor_diameter
};
constexpr std::size_t setup_quantity_count = 8;

/// As input files and people call them, in the order of SetupQuantity.
inline constexpr std::array<const char*, setup_quantity_count> setup_quantity_names{
    "theta_i",         "theta_r",           "source_in_plane",        "source_perpendicular",
    "source_diameter", "receptor_in_plane", "receptor_perpendicular", "receptor_diameter"};
[[nodiscard]] std::optional<SetupQuantity> setup_quantity(const std::string& name);

/// What the standard says of the size of an aperture, `unknown` included; null if the quantity is
/// an angle, or the aperture is of another shape.
[[nodiscard]] const ApertureSize* aperture_size(const GeometryLimits& limits,
                                                SetupQuantity quantity);

/// What the standard says of it; null where it says nothing or the number is unknown.
[[nodiscard]] const Stated<Angle>* limit_of(const GeometryLimits& limits, SetupQuantity quantity);

}  // namespace gonio

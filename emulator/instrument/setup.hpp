#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/standard/setup_quantity.hpp"

namespace gonio {

/// A quantity as it was found, and how well.
struct StatedAngle {
  Angle value;
  Angle expanded_uncertainty = {};  ///< k = 2; 0 if it is stated without one

  bool operator==(const StatedAngle&) const = default;
};

/// All of one geometry, in the order of SetupQuantity; nothing where it is not stated.
using StatedSetup = std::array<std::optional<StatedAngle>, setup_quantity_count>;

/// As built, or nominal where the file does not say; nothing if the instrument has no such geometry
/// or the geometry no such quantity (a circle has no sides), or if it is unknown.
[[nodiscard]] std::optional<StatedAngle> as_built(const Instrument& instrument,
                                                  const std::string& geometry_id,
                                                  SetupQuantity quantity);

/// How well that quantity is known, k = 2: as stated with it, else as the instrument's
/// `setup_uncertainty` says, also of what is nominal for lack of another value; nothing if neither
/// says anything.
[[nodiscard]] std::optional<Angle> stated_uncertainty(const Instrument& instrument,
                                                      const std::string& geometry_id,
                                                      SetupQuantity quantity);

/// The same instrument with that quantity at another value, known as well as `value` says. A size
/// that the standard leaves unknown can be set.
/// @throws std::invalid_argument  if there is no such geometry, or it has no such quantity.
[[nodiscard]] Instrument with_quantity(Instrument instrument, const std::string& geometry_id,
                                       SetupQuantity quantity, const StatedAngle& value);

/// The same instrument by the numbers of another standard, in the geometries that both have. What
/// is not stated as built stays as the standard says that it was built to.
/// @throws std::invalid_argument  if they have no geometry in common.
[[nodiscard]] Instrument by_standard(const Instrument& instrument, const Standard& standard);

}  // namespace gonio

#pragma once

#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/instrument/setup.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// A sample of the ladder on which effects are shown, matt to mirror.
struct LadderRow {
  std::string sample, title;
  double nominal_gu = 0.0;   ///< as the standard says
  double as_built_gu = 0.0;  ///< change of the reading with the quantity as built, all else nominal
  double low_gu = 0.0;       ///< with the quantity at its lower limit
  double high_gu = 0.0;      ///< with the quantity at its upper limit
};

/// What a deviation of one quantity of a set-up does to readings, with the reference read through
/// the same set-up, so that what cancels, cancels.
struct SetupEffects {
  std::string geometry;
  SetupQuantity quantity;
  Angle nominal, as_built, low, high;
  std::vector<LadderRow> rows = {};
};

/// Twelve samples and more, from matt to mirror by their gloss at 60 deg, of dielectrics and
/// metals; dependent only on models that have a closed form or are checked by one.
[[nodiscard]] std::vector<Sample> effect_ladder(const WavelengthGrid& grid);

/// Effects of every quantity of that geometry whose nominal value and tolerance the standard tells.
///
/// One quantity is changed at a time; all others keep their nominal values, and openings that the
/// standard leaves unknown are as built. So a receptor stays where it is when theta_i changes, as
/// in an instrument whose source was aimed wrongly: the image of the source moves in it. A mirror
/// whose image stays within the receptor shows the change of Fresnel's reflectance alone, as it
/// would if the receptor followed; a lobe shows how it shifts too.
///
/// @param instrument  as built, for `as_built_gu`; 0 for a quantity that it does not have, since
/// its
///                    opening is of another shape.
/// @param ladder      surfaces of one wavelength grid.
/// @param tolerance   asked of the integrator, in GU.
/// @return            in the order of SetupQuantity; rows in the order of the ladder.
/// @throws InputError             for an aperture of unknown size that is not stated as built.
/// @throws std::out_of_range      if the standard has no such geometry.
[[nodiscard]] std::vector<SetupEffects> setup_effects(const Instrument& instrument,
                                                      const std::string& geometry_id,
                                                      const std::vector<Sample>& ladder,
                                                      double tolerance);

}  // namespace gonio

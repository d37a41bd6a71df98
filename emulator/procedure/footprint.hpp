#pragma once

#include <string>
#include <vector>

#include "emulator/instrument/instrument.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// A closed line in the plane of the receptor, in degrees from the nominal mirror direction: the
/// angles atan u and atan v of the plane tangent there, in which an opening has the sizes that
/// standards give it. The in-plane angle grows with theta_r.
struct FootprintOutline {
  std::string title;  ///< e.g. receptor as built, source image by the standard
  /// Corners, the first one again at the end.
  std::vector<double> in_plane_deg = {}, perpendicular_deg = {};
};

/// What the receptor of one geometry sees: its own edge, the image of the source, and the lobe of a
/// sample behind them.
struct Footprint {
  std::string geometry;
  std::string sample;  ///< whose lobe it is
  std::vector<FootprintOutline> outlines = {};
  /// What a receptor collects from each direction of a grid: the luminous radiance of the lobes in
  /// the light of the source as built times cos theta_r, relative to its maximum. A smooth
  /// interface adds nothing here: all that it reflects lies within the source image.
  std::vector<double> in_plane_deg = {}, perpendicular_deg = {};
  std::vector<double> radiance = {};  ///< shape (n_perpendicular, n_in_plane), row-major
};

/// The outlines are `receptor as built`, `source image as built` and, unless the standard leaves a
/// size unknown, `receptor by the standard` and `source image by the standard`. The image of the
/// source is what a flat mirror in the place of the sample shows.
///
/// @param sample  with at least one lobe, e.g. a semi-gloss paint.
/// @throws std::invalid_argument  if the sample has no lobe.
/// @throws std::out_of_range      if the instrument has no such geometry.
/// @throws InputError             for an aperture of unknown size.
[[nodiscard]] Footprint footprint(const Instrument& instrument, const std::string& geometry_id,
                                  const Sample& sample);

}  // namespace gonio

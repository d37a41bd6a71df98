#pragma once

#include <optional>

#include "emulator/core/angle.hpp"
#include "emulator/integration/aperture.hpp"

namespace gonio {

/// Where the arms of a goniometer stand. In the frame of the stage the source is at azimuth pi; the
/// sample is turned about its normal, counterclockwise as seen from above, so that in its frame
/// both directions turn the other way.
struct ScanPosition {
  Angle theta_i;        ///< in [0, 90) deg
  Angle theta_r;        ///< in (-90, 90) deg; a negative one is past the normal
  Angle phi_r = {};     ///< azimuth of the receptor on the stage; 0 where a mirror sends the light
  Angle rotation = {};  ///< of the sample

  /// Azimuths in the frame of the sample, in [0, 360) deg; that of the receptor for a polar angle
  /// that is not negative.
  [[nodiscard]] Angle azimuth_i() const;
  [[nodiscard]] Angle azimuth_r() const;
  /// The angle between the axes of source and receptor: what the two heads have for themselves.
  [[nodiscard]] Angle between_heads() const;
};

/// The opening of a source or a receptor by its full angles, wherever it is moved.
struct ScanOpening {
  Aperture::Outline outline = Aperture::Outline::circle;
  Angle in_plane;       ///< the diameter of a circle
  Angle perpendicular;  ///< the same for a circle

  [[nodiscard]] bool is_collimated() const { return in_plane == Angle{}; }
  [[nodiscard]] Aperture at(const Frame& frame) const;

  bool operator==(const ScanOpening&) const = default;
};

/// The frame of any axis: u grows with the polar angle, v with the azimuth. Azimuths of whole
/// quarter turns are exact, so that apertures in the plane of measurement are found symmetric.
[[nodiscard]] Frame frame_towards(Angle theta, Angle azimuth);

/// The apertures of one position, in the frame of the sample.
[[nodiscard]] MeasuringGeometry scan_geometry(const ScanPosition& position,
                                              const ScanOpening& source,
                                              const ScanOpening& receptor);

/// The position at which source and receptor have changed places, seen from the sample.
[[nodiscard]] ScanPosition exchanged(const ScanPosition& position);

}  // namespace gonio

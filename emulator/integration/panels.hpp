#pragma once

#include <optional>
#include <vector>

#include "emulator/integration/region.hpp"
#include "emulator/surface/surface.hpp"

// How apertures are cut into panels for a lobe: which rule an axis gets, and where panels end.

namespace gonio {

/// Where a lobe peaks in a tangent plane, and how far it spreads there.
struct Peak {
  PlanePoint at;
  double width_u, width_v;
};

/// How far a lobe spreads round the mirror direction, in tangents, along u and v of a frame.
struct LobeWidth {
  double u, v;

  /// @param slope  widths in slopes of the half vector: they turn the reflected light by twice as
  ///               much in the plane of incidence, and 2 cos_theta_d times as much across it.
  LobeWidth(const SlopeWidth& slope, double cos_theta_d);
  /// The same for a frame turned by 90 deg about its axis.
  [[nodiscard]] LobeWidth turned() const;
};

/// The peak that a lobe of this width, round the direction omega, has in the plane of a frame.
/// @return  nothing if omega does not meet the plane.
[[nodiscard]] std::optional<Peak> peak_in(const Frame& frame, const Vector3& omega,
                                          const LobeWidth& width);

/// The middles of the receptor's edges in the tangent plane of the source, seen in the mirror, with
/// the width of the lobe. As a function of the direction of incidence, what arrives in the receptor
/// changes there. @return  low u, high u, low v, high v; none if an edge is out of sight.
[[nodiscard]] std::vector<Peak> receptor_edges(const MeasuringGeometry& geometry,
                                               const LobeWidth& width);

/// The scale on which the receptor's signal changes over the source: the width of the lobe, or the
/// gap between the source image and the edges of the receptor if that is wider.
[[nodiscard]] std::optional<Peak> scale_over_source(const Aperture& source,
                                                    const std::vector<Peak>& edges);

/// How one axis is cut and which rule it gets.
struct AxisPlan {
  int gauss_points;
  double first_break;  ///< of a series that grows away from the peak, in widths of the lobe
};

/// How both axes of an aperture are cut for a lobe.
struct Plan {
  AxisPlan p, q;

  /// @param peak                nothing where the lobe has no peak to speak of.
  /// @param relative_tolerance  in (0, 1).
  Plan(const Aperture& aperture, const std::optional<Peak>& peak, double relative_tolerance);
};

/// Where panels end, in the coordinates of a region.
struct Breaks {
  std::vector<double> p, q;

  /// Adds breaks in u, or in v, on both sides of a peak. @param reach  in widths of the lobe.
  void add_u(const Region& region, const Peak& peak, const AxisPlan& plan, double reach);
  void add_v(const Region& region, const Peak& peak, const AxisPlan& plan, double reach);
  /// Replaces the breaks at q < 0 by those at q > 0, mirrored.
  void make_q_symmetric();
};

}  // namespace gonio

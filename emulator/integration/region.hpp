#pragma once

#include <optional>
#include <vector>

#include "emulator/integration/aperture.hpp"

namespace gonio {

/// The points of an aperture, or of its overlap with another one, as rows of its tangent plane:
/// for each p a coordinate u and a stretch of v. p is u itself for a rectangle and the angle with
/// u = R sin p for a circle, so that rows depend smoothly on p.
class Region {
 public:
  struct Row {
    double u;
    double du_dp;
    double v_low, v_high;  // v_high < v_low: nothing of the row is in the region
  };

  explicit Region(const Aperture& aperture) : aperture_(aperture) {}
  /// The directions of `aperture` that are in `other` too.
  Region(const Aperture& aperture, const Aperture& other) : aperture_(aperture), other_(other) {}

  [[nodiscard]] const Frame& frame() const { return aperture_.frame(); }
  [[nodiscard]] double p_low() const;
  [[nodiscard]] double p_high() const;
  /// False where the aperture is a line or a point: there is one row, or one point in each.
  [[nodiscard]] bool has_extent_p() const { return aperture_.u_low() != aperture_.u_high(); }
  [[nodiscard]] bool has_extent_q() const { return aperture_.v_low() != aperture_.v_high(); }
  /// All rows have the same v, and u is p: a whole rectangle.
  [[nodiscard]] bool has_equal_rows() const {
    return !other_ && aperture_.outline() == Aperture::Outline::rectangle;
  }
  [[nodiscard]] Row row(double p) const;
  /// p of the row at u, clamped to the region.
  [[nodiscard]] double p_at(double u) const;
  /// The p inside the region at which the overlap has corners.
  [[nodiscard]] std::vector<double> corners() const;

 private:
  void clip(Row& row) const;
  Aperture aperture_;
  std::optional<Aperture> other_;
};

/// A point of a tangent plane.
struct PlanePoint {
  double u, v;
};

/// Where a direction meets the tangent plane of a frame; nothing for one that never does.
[[nodiscard]] std::optional<PlanePoint> project(const Frame& frame, const Vector3& omega);

}  // namespace gonio

#pragma once

#include <optional>

namespace gonio {

/// A stretch of a line. @invariant low < high
struct Chord {
  double low = 0.0, high = 0.0;
};

/// A rectangle or an ellipse on a panel, its sides or axes along those of the panel. [mm]
struct Outline {
  enum class Kind { rectangle, ellipse };
  Kind kind = Kind::rectangle;
  double x_mm = 0.0, y_mm = 0.0;                     ///< of its centre
  double half_length_mm = 0.0, half_width_mm = 0.0;  ///< along x and along y, > 0

  [[nodiscard]] double area_mm2() const;
  /// What of the line at `y_mm` lies within; nothing where there is no length of it.
  [[nodiscard]] std::optional<Chord> chord(double y_mm) const;
};

/// The part that both have in common; nothing if it has no length.
[[nodiscard]] std::optional<Chord> common(const Chord& a, const Chord& b);

}  // namespace gonio

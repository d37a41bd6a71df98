#pragma once

#include <limits>

namespace gonio {

/// What is known of a quantity besides its estimate: how far the estimate may be off. Symmetric
/// about it. @see JCGM 100:2008, 4.3 and JCGM 101:2008, 6.4
struct Distribution {
  enum class Shape { normal, student, rectangular, triangular, arcsine };

  Shape shape = Shape::normal;
  double standard_uncertainty = 0.0;  ///< >= 0, in the unit of the quantity
  /// Of the standard uncertainty, > 0. A normal shape that has few becomes Student's, of scale
  /// standard_uncertainty. @see JCGM 101:2008, 6.4.9
  double degrees_of_freedom = std::numeric_limits<double>::infinity();

  bool operator==(const Distribution&) const = default;

  /// @param half_width  >= 0, of what is bounded.
  /// @throws std::domain_error  for a negative one, or for a shape without bounds.
  [[nodiscard]] static Distribution bounded(Shape shape, double half_width);

  /// Half the width of what is bounded; infinite for a normal or Student's shape.
  [[nodiscard]] double half_width() const;
};

/// The deviation from the estimate below which a share p of the distribution lies.
/// @param p  in (0, 1).
/// @throws std::domain_error  for p or a member of the distribution outside its range.
[[nodiscard]] double quantile(const Distribution& distribution, double p);

/// The coverage factor k of Student's t for a share `coverage` in the middle.
/// @param degrees_of_freedom  > 0, not rounded; infinite for the normal distribution.
/// @param coverage            in (0, 1).
/// @throws std::domain_error  for anything else.
[[nodiscard]] double coverage_factor(double degrees_of_freedom, double coverage = 0.95);

}  // namespace gonio

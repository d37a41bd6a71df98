#pragma once

#include "emulator/surface/outline.hpp"

namespace gonio {

/// What a glossmeter lights and sees of a sample: an ellipse. x runs along the plane of
/// measurement. Half axes of 0 make a point.
struct Spot {
  double x_mm = 0.0, y_mm = 0.0;
  double half_length_mm = 0.0, half_width_mm = 0.0;  ///< along x and along y, >= 0

  bool operator==(const Spot&) const = default;
};

/// The spot as an outline with an area: a point becomes too small to matter.
[[nodiscard]] Outline outline_of(const Spot& spot);

/// Correlation of what two spots average of a random field over the sample whose variance is 1 and
/// whose correlation over a distance d is exp(-d^2 / (2 L^2)): its mean over all pairs of a point
/// of the one and a point of the other. It is the covariance of both averages; that of a spot with
/// itself is the variance that is left of the field.
///
/// @param correlation_length_mm  L, >= 0; infinite gives 1. With 0 each place is for itself: 1 of a
///                               point with itself, 0 of all else.
/// @return  in [0, 1], to 1e-3.
/// @throws std::domain_error  if L is negative or NaN.
[[nodiscard]] double spot_correlation(const Spot& a, const Spot& b, double correlation_length_mm);

}  // namespace gonio

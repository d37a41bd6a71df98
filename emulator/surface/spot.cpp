#include "emulator/surface/spot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace gonio {

namespace {

using std::numbers::pi;

/// A chord of an ellipse, and the width of the strip that it stands for.
struct Line {
  double y, width;
  Chord chord;
};

/// Strips that are narrower at the ends, where the edge of an ellipse turns: the midpoint rule in
/// the angle.
std::vector<Line> lines_of(const Outline& ellipse, int n) {
  std::vector<Line> lines;
  for (int i = 0; i < n; ++i) {
    const double angle = pi * ((i + 0.5) / n - 0.5);
    const double y = ellipse.y_mm + ellipse.half_width_mm * std::sin(angle);
    if (const auto chord = ellipse.chord(y)) {
      lines.push_back({y, ellipse.half_width_mm * std::cos(angle) * pi / n, *chord});
    }
  }
  return lines;
}

/// The integral of exp(-(x - x')^2 / (2 L^2)) over x in `a` and x' in `b`.
double integral_over_pairs(const Chord& a, const Chord& b, double L) {
  const auto twice_integrated = [L](double d) {
    return L * (std::sqrt(pi / 2.0) * d * std::erf(d / (L * std::numbers::sqrt2)) +
                L * std::exp(-0.5 * d * d / (L * L)));
  };
  return twice_integrated(a.high - b.low) - twice_integrated(a.high - b.high) -
         twice_integrated(a.low - b.low) + twice_integrated(a.low - b.high);
}

double area_of_both(const Outline& a, const Outline& b) {
  constexpr int lines = 1024;
  double area = 0.0;
  for (const Line& line : lines_of(a, lines)) {
    const auto other = b.chord(line.y);
    const auto both = other ? common(line.chord, *other) : std::nullopt;
    area += both ? line.width * (both->high - both->low) : 0.0;
  }
  return area;
}

bool is_point(const Spot& spot) { return spot.half_length_mm == 0.0 && spot.half_width_mm == 0.0; }

/// An ellipse that is not too small for differences of what is integrated over it.
Outline widened(const Spot& spot, double L) {
  constexpr double least = 1e-4;  // changes a result by its square
  Outline outline = outline_of(spot);
  outline.half_length_mm = std::max(outline.half_length_mm, least * L);
  outline.half_width_mm = std::max(outline.half_width_mm, least * L);
  return outline;
}

}  // namespace

Outline outline_of(const Spot& spot) {
  constexpr double least_mm = 1e-6;
  return {.kind = Outline::Kind::ellipse,
          .x_mm = spot.x_mm,
          .y_mm = spot.y_mm,
          .half_length_mm = std::max(spot.half_length_mm, least_mm),
          .half_width_mm = std::max(spot.half_width_mm, least_mm)};
}

double spot_correlation(const Spot& a, const Spot& b, double correlation_length_mm) {
  constexpr int fewest_lines = 32, most_lines = 160;
  const double L = correlation_length_mm;
  if (!(L >= 0.0)) {
    throw std::domain_error(
        fmt::format("spot_correlation: the correlation length must be >= 0 mm, "
                    "is {}",
                    L));
  }
  if (std::isinf(L)) {
    return 1.0;
  }
  if (L == 0.0) {
    return is_point(a) && a == b ? 1.0 : 0.0;
  }
  const Outline outline_a = widened(a, L), outline_b = widened(b, L);
  // The sum over one of both has to resolve L: the one of narrower strips.
  const double finer = std::min(outline_a.half_width_mm, outline_b.half_width_mm);
  const double needed = std::ceil(pi * finer / L);
  const double areas = outline_a.area_mm2() * outline_b.area_mm2();
  if (needed > most_lines) {  // only what both cover is so near to itself
    return 2.0 * pi * L * L * area_of_both(outline_a, outline_b) / areas;
  }
  const int n = std::max(fewest_lines, int(needed));
  double sum = 0.0;
  const std::vector<Line> lines_b = lines_of(outline_b, n);
  for (const Line& line_a : lines_of(outline_a, n)) {
    for (const Line& line_b : lines_b) {
      const double d = (line_a.y - line_b.y) / L;
      sum += line_a.width * line_b.width * std::exp(-0.5 * d * d) *
             integral_over_pairs(line_a.chord, line_b.chord, L);
    }
  }
  return std::clamp(sum / areas, 0.0, 1.0);
}

}  // namespace gonio

#include "reports/page_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/axis_span.hpp"
#include "reports/conformance_words.hpp"

namespace gonio {

namespace {

/// What holds all the outlines and the grid.
AxisSpan window(const Footprint& footprint, const std::vector<double>& grid,
                std::vector<double> FootprintOutline::*axis) {
  AxisSpan span{0.0, 0.0};
  if (grid.size() > 1) {
    // Half a pixel of the picture lies outside of the middles of its edge.
    const double half = (grid.back() - grid.front()) / double(grid.size() - 1) / 2.0;
    span.include(grid.front() - half);
    span.include(grid.back() + half);
  }
  for (const FootprintOutline& outline : footprint.outlines) {
    for (const double value : outline.*axis) {
      span.include(value);
    }
  }
  constexpr double least_deg = 0.2;
  return span.at_least(least_deg);
}

/// From zero to a little above all the values; to 1 if there are none.
AxisSpan value_axis(const std::vector<Rows>& groups) {
  AxisSpan span{0.0, 0.0};
  for (const Rows& rows : groups) {
    for (const std::vector<double>& row : rows) {
      span.include(row.back());
    }
  }
  constexpr double room = 0.05;
  const double length = span.high - span.low;
  return length > 0.0 ? AxisSpan{span.low - (span.low < 0.0 ? room * length : 0.0),
                                 span.high + room * length}
                      : AxisSpan{0.0, 1.0};
}

/// From the first to the last wavelength; the visible ones if there are none.
AxisSpan wavelength_axis(const std::vector<SpectralCurve>& curves) {
  AxisSpan span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const SpectralCurve& curve : curves) {
    for (const double lambda : curve.wavelength_nm) {
      span.include(lambda);
    }
  }
  return span.low <= span.high ? span.at_least(1.0) : AxisSpan{380.0, 780.0};
}

/// Whether there is a picture to draw.
bool has_lobe(const Footprint& footprint) {
  return footprint.in_plane_deg.size() > 1 && footprint.perpendicular_deg.size() > 1 &&
         std::any_of(footprint.radiance.begin(), footprint.radiance.end(),
                     [](double value) { return std::isfinite(value); });
}

/// As gnuplot wants a matrix with angles: the row of angles, then each row behind its angle.
Rows lobe_matrix(const Footprint& footprint) {
  const std::size_t columns = footprint.in_plane_deg.size();
  Rows rows{{double(columns)}};
  rows.front().insert(rows.front().end(), footprint.in_plane_deg.begin(),
                      footprint.in_plane_deg.end());
  for (std::size_t j = 0; j < footprint.perpendicular_deg.size(); ++j) {
    rows.push_back({footprint.perpendicular_deg[j]});
    for (std::size_t i = 0; i < columns; ++i) {
      rows.back().push_back(footprint.radiance.at(j * columns + i));
    }
  }
  return rows;
}

/// Points (x, y).
Rows points(const std::vector<double>& x, const std::vector<double>& y) {
  Rows rows;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    rows.push_back({x[i], y[i]});
  }
  return rows;
}

}  // namespace

PageData footprint_figure(Figures& figures, const Footprint& footprint) {
  std::vector<Rows> outlines;
  std::vector<std::string> keys;
  for (const FootprintOutline& outline : footprint.outlines) {
    outlines.push_back(points(outline.in_plane_deg, outline.perpendicular_deg));
    keys.push_back(outline.title);
  }
  const AxisSpan x = window(footprint, footprint.in_plane_deg, &FootprintOutline::in_plane_deg);
  const AxisSpan y =
      window(footprint, footprint.perpendicular_deg, &FootprintOutline::perpendicular_deg);
  Chart chart("footprint");
  chart.set("x_low", x.low).set("x_high", x.high).set("y_low", y.low).set("y_high", y.high);
  chart.set("has_lobe", has_lobe(footprint) ? 1.0 : 0.0);
  chart.set("count", double(outlines.size()));
  chart.block("outlines", outlines);
  chart.block("lobe", {has_lobe(footprint) ? lobe_matrix(footprint) : Rows()});
  return figures.figure(
      chart,
      fmt::format("Geometry {}: edges of the receptor and of the source image, over the lobe of {}",
                  footprint.geometry, footprint.sample),
      keys);
}

PageData curves_figure(Figures& figures, CurveKind kind, const std::string& caption,
                       const std::vector<SpectralCurve>& curves) {
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  groups.reserve(curves.size());
  keys.reserve(curves.size());
  for (const SpectralCurve& curve : curves) {
    groups.push_back(points(curve.wavelength_nm, curve.value));
    keys.push_back(curve.title);
  }
  Chart chart("curves");
  const AxisSpan x = wavelength_axis(curves);
  const AxisSpan y = value_axis(groups);
  chart.set("kind", double(kind));
  chart.set("x_low", x.low).set("x_high", x.high).set("y_low", y.low).set("y_high", y.high);
  chart.set("count", double(curves.size())).block("curves", groups);
  return figures.figure(chart, caption, keys);
}

PageData ladder_figure(Figures& figures, const std::vector<const SetupEffects*>& effects) {
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  std::vector<std::string> samples;
  groups.reserve(effects.size());
  keys.reserve(effects.size());
  for (const SetupEffects* quantity : effects) {
    Rows rows;
    for (const LadderRow& row : quantity->rows) {
      const double effect = std::max(std::abs(row.low_gu), std::abs(row.high_gu));
      rows.push_back({double(rows.size() + 1), effect});
      if (rows.size() > samples.size()) {
        samples.push_back(fmt::format("{} ({} GU)", row.title, number_text(row.nominal_gu)));
      }
    }
    groups.push_back(rows);
    keys.emplace_back(quantity_name(*quantity));
  }
  const AxisSpan y = value_axis(groups);
  Chart chart("ladder");
  chart.set("y_low", y.low).set("y_high", y.high);
  chart.set("count", double(groups.size())).set("samples", double(samples.size()));
  chart.block("effects", groups);
  PageData data = figures.figure(
      chart,
      fmt::format("Geometry {}: by how much readings change at most when one quantity goes to a "
                  "limit and all others stay nominal",
                  effects.front()->geometry),
      keys);
  set_list(data, "samples", text_list(samples));
  return data;
}

}  // namespace gonio

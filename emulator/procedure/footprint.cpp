#include "emulator/procedure/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/integration/region.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index columns = 61;
constexpr Index rows = 41;
/// By how much the window is larger than all outlines together.
constexpr double margin = 1.25;
/// Of the integrator, relative to the radiance in the mirror direction: no picture shows less.
constexpr double accuracy = 1e-4;

/// A point of the tangent plane as two angles.
struct PlaneAngles {
  double in_plane_deg, perpendicular_deg;
};

PlaneAngles angles_of(const PlanePoint& point) {
  return {.in_plane_deg = radians(std::atan(point.u)).degrees(),
          .perpendicular_deg = radians(std::atan(point.v)).degrees()};
}

double tangent_of(double deg) { return std::tan(degrees(deg).radians()); }

/// The corners of an aperture in its own tangent plane; a circle is a polygon.
std::vector<PlanePoint> corners_of(const Aperture& aperture) {
  if (aperture.outline() == Aperture::Outline::rectangle) {
    return {{aperture.u_low(), aperture.v_low()},
            {aperture.u_high(), aperture.v_low()},
            {aperture.u_high(), aperture.v_high()},
            {aperture.u_low(), aperture.v_high()}};
  }
  constexpr int sides = 72;
  std::vector<PlanePoint> corners;
  for (int i = 0; i < sides; ++i) {
    const double at = 2.0 * std::numbers::pi * i / sides;
    corners.push_back({aperture.u_high() * std::cos(at), aperture.u_high() * std::sin(at)});
  }
  return corners;
}

/// @param plane  of the receptor, round the nominal mirror direction.
FootprintOutline outline(const std::string& title, const Aperture& aperture, const Frame& plane) {
  FootprintOutline result{.title = title};
  for (const PlanePoint& corner : corners_of(aperture)) {
    const auto point = project(plane, aperture.frame().direction(corner.u, corner.v));
    if (!point) {
      throw std::domain_error("footprint: the " + title + " is 90 deg off the mirror direction");
    }
    const PlaneAngles angles = angles_of(*point);
    result.in_plane_deg.push_back(angles.in_plane_deg);
    result.perpendicular_deg.push_back(angles.perpendicular_deg);
  }
  result.in_plane_deg.push_back(result.in_plane_deg.front());
  result.perpendicular_deg.push_back(result.perpendicular_deg.front());
  return result;
}

std::vector<FootprintOutline> outlines_of(const Instrument& instrument,
                                          const std::string& geometry_id, const Frame& plane) {
  const auto add = [&](std::vector<FootprintOutline>& list, const MeasuringGeometry& geometry,
                       const std::string& by) {
    list.push_back(outline("receptor " + by, geometry.receptor, plane));
    list.push_back(outline("source image " + by, geometry.source.mirrored(), plane));
  };
  std::vector<FootprintOutline> outlines;
  add(outlines, instrument.geometry(geometry_id), "as built");
  const GeometryLimits& limits = instrument.standard.geometry(geometry_id);
  if (limits.source.is_known() && limits.receptor.is_known()) {
    add(outlines, nominal_instrument(instrument.standard).geometry(geometry_id), "by the standard");
  }
  return outlines;
}

/// Equally spaced angles that hold all corners, with a margin; shape (count).
std::vector<double> window(const std::vector<FootprintOutline>& outlines,
                           std::vector<double> FootprintOutline::*axis, Index count) {
  double low = 0.0;
  double high = 0.0;
  for (const FootprintOutline& outline : outlines) {
    const auto [least, most] = std::ranges::minmax(outline.*axis);
    low = std::min(low, least);
    high = std::max(high, most);
  }
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * margin * (high - low);
  const ArrayXd angles = ArrayXd::LinSpaced(count, middle - half, middle + half);
  return {angles.begin(), angles.end()};
}

/// What one direction of the receptor's plane receives from the lobes of a sample.
class LobeView {
 public:
  LobeView(const Instrument& instrument, const Aperture& source, const Surface& surface,
           const Frame& plane)
      : source_(source), surface_(surface), plane_(plane) {
    if (!surface_.scatters()) {
      throw std::invalid_argument("footprint: the sample needs a lobe");
    }
    surface_.interfaces.clear();
    weight_ = instrument.source.sample(surface.grid) * instrument.responsivity.sample(surface.grid);
    weight_ /= weight_.sum();
    const double incident = integrator_.incident(source_);
    tolerance_ = accuracy * incident;
    tolerance_ = accuracy * std::max((*this)({0.0, 0.0}), accuracy * incident);
  }

  /// int_source f_r cos i cos r d omega_i, luminous; 0 below the horizon of the sample.
  double operator()(const PlanePoint& at) const {
    const Vector3 omega_r = plane_.direction(at.u, at.v);
    if (!(omega_r.z() > 0.0)) {
      return 0.0;
    }
    const MeasuringGeometry to_one_direction{.source = source_, .receptor = collimated(omega_r)};
    const Flux flux = integrator_.reflected(surface_, to_one_direction, weight_, tolerance_);
    return (weight_ * flux.spectral).sum();
  }

 private:
  Aperture source_;
  Surface surface_;
  Frame plane_;
  ApertureIntegrator integrator_;
  ArrayXd weight_;
  double tolerance_ = 0.0;
};

}  // namespace

Footprint footprint(const Instrument& instrument, const std::string& geometry_id,
                    const Sample& sample) {
  const Angle theta = instrument.standard.geometry(geometry_id).theta_i.nominal;
  const Frame plane = receptor_frame(theta);
  Footprint result{.geometry = geometry_id, .sample = sample.id};
  result.outlines = outlines_of(instrument, geometry_id, plane);
  result.in_plane_deg = window(result.outlines, &FootprintOutline::in_plane_deg, columns);
  result.perpendicular_deg = window(result.outlines, &FootprintOutline::perpendicular_deg, rows);
  const Aperture source = instrument.geometry(geometry_id).source;
  const LobeView view(instrument, source.seen_by_tilted(sample.tilt), sample.surface,
                      plane.turned_about_y(-sample.tilt));
  result.radiance.resize(std::size_t(rows * columns));
  parallel_for(std::size_t(rows), [&](std::size_t row) {
    for (std::size_t column = 0; column < std::size_t(columns); ++column) {
      result.radiance[row * std::size_t(columns) + column] = view(
          {tangent_of(result.in_plane_deg[column]), tangent_of(result.perpendicular_deg[row])});
    }
  });
  const double most = std::ranges::max(result.radiance);
  if (most > 0.0) {
    std::ranges::for_each(result.radiance, [most](double& value) { value /= most; });
  }
  return result;
}

}  // namespace gonio

#include "reports/scan_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "emulator/core/unit_value.hpp"
#include "reports/chart_rows.hpp"

namespace gonio {

namespace {

constexpr std::size_t most_lobes = 8;    // as many as lines that can be told apart
constexpr std::size_t most_spheres = 6;  // each of them is some thousand polygons
constexpr double most_decades = 6.0;

std::size_t shown(const ScanReport& report, std::size_t most) {
  return std::min(report.lobes.size(), most);
}

std::string lobe_words(const ScanReport& report, const ScanLobe& lobe) {
  const bool is_turned = std::ranges::any_of(
      report.lobes, [](const ScanLobe& other) { return other.rotation != Angle{}; });
  const std::string from = fmt::format("from {:g} deg", stated_degrees(lobe.theta_i));
  return is_turned ? fmt::format("{}, turned by {:g} deg", from, stated_degrees(lobe.rotation))
                   : from;
}

/// Exponents of ten that hold the values, six decades at most below the highest.
AxisSpan decades_of(const ScanReport& report, const std::vector<Eigen::Index>& positions) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Eigen::Index p : positions) {
    const double f_r = report.result.weighted(p);
    if (f_r > 0.0) {
      low = std::min(low, std::log10(f_r));
      high = std::max(high, std::log10(f_r));
    }
  }
  if (!(low <= high)) {
    return {-1.0, 0.0};
  }
  return {std::max(low, high - most_decades), std::max(high, low + 0.1)};
}

/// Polar angle from the normal towards the mirror side; nothing out of the plane of measurement.
std::optional<double> in_plane_deg(const ScanPosition& position) {
  ScanPosition unturned = position;
  unturned.rotation = {};
  const double theta = std::abs(position.theta_r.degrees());
  const double azimuth = unturned.azimuth_r().degrees();
  if (theta == 0.0 || azimuth == 0.0) {
    return theta;
  }
  return azimuth == 180.0 ? std::optional(-theta) : std::nullopt;
}

std::vector<double> on_circle(double radius, double angle_deg) {
  const double angle = degrees(angle_deg).radians();
  return {radius * std::sin(angle), radius * std::cos(angle)};
}

/// Points round the normal, of one lobe: (x, y), a gap where heads collide.
Rows in_plane_rows(const ScanReport& report, const ScanLobe& lobe, const AxisSpan& exponents) {
  std::map<double, double> profile;
  for (const Eigen::Index p : lobe.positions) {
    if (const auto angle = in_plane_deg(report.result.positions[std::size_t(p)])) {
      profile[*angle] = report.result.weighted(p);
    }
  }
  Rows rows;
  for (const auto& [angle, f_r] : profile) {
    const double exponent = f_r > 0.0 ? std::log10(f_r) : exponents.low;
    const double radius =
        std::max((exponent - exponents.low) / (exponents.high - exponents.low), 0.0);
    rows.push_back(std::isnan(f_r) ? std::vector{gap, gap} : on_circle(radius, angle));
  }
  return rows;
}

/// A net of circles from one angle to another, and spokes.
std::vector<Rows> net(const std::vector<double>& radii, double from_deg, double to_deg,
                      double spoke_deg) {
  std::vector<Rows> groups;
  for (const double radius : radii) {
    Rows circle;
    for (double angle = from_deg; angle <= to_deg; angle += 3.0) {
      circle.push_back(on_circle(radius, angle));
    }
    groups.push_back(circle);
  }
  for (double angle = from_deg; angle <= to_deg; angle += spoke_deg) {
    groups.push_back({on_circle(0.0, angle), on_circle(1.0, angle)});
  }
  return groups;
}

/// Where a hemisphere shows a receptor: the mirror side to the right.
std::vector<double> seen_from_above(double theta_deg, double azimuth_deg) {
  const double radius = theta_deg / 90.0;
  const double azimuth = degrees(azimuth_deg).radians();
  return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

/// The grid of one lobe: a scan line for each azimuth, the first once more where it goes all round.
Rows hemisphere_rows(const ScanReport& report, const ScanLobe& lobe, const AxisSpan& exponents) {
  std::map<double, std::map<double, double>> grid;
  std::optional<double> at_normal;
  for (const Eigen::Index p : lobe.positions) {
    ScanPosition position = report.result.positions[std::size_t(p)];
    position.rotation = {};
    if (position.theta_r == Angle{}) {
      at_normal = report.result.weighted(p);
    } else {
      grid[position.azimuth_r().degrees()][position.theta_r.degrees()] = report.result.weighted(p);
    }
  }
  constexpr double all_round_deg = 45.0;  // what is left of a turn after the last azimuth
  if (grid.begin()->first + 360.0 - grid.rbegin()->first < all_round_deg + 1e-6) {
    const auto first = *grid.begin();
    grid[first.first + 360.0] = first.second;
  }
  Rows rows;
  for (auto& [azimuth, line] : grid) {
    if (at_normal) {
      line[0.0] = *at_normal;
    }
    for (const auto& [theta, f_r] : line) {
      std::vector<double> row = seen_from_above(theta, azimuth);
      row.push_back(std::isnan(f_r) ? gap
                                    : std::max(std::log10(std::max(f_r, 1e-300)), exponents.low));
      rows.push_back(row);
    }
    rows.emplace_back();
  }
  return rows;
}

PageData hemisphere_figure(Figures& figures, const ScanReport& report, const ScanLobe& lobe) {
  const AxisSpan exponents = decades_of(report, lobe.positions);
  const std::vector<double> polar_deg{30.0, 60.0, 90.0};
  constexpr double on_the_map = 0xffffff, beside_it = 0x222222;  // colours of labels
  std::vector<double> radii;
  Rows labels;
  for (const double theta : polar_deg) {
    radii.push_back(theta / 90.0);
    labels.push_back(seen_from_above(theta, 55.0));
    labels.back().push_back(theta);
    labels.back().push_back(theta < 90.0 ? on_the_map : beside_it);
  }
  Chart chart("lobe_hemisphere");
  chart.set("low", exponents.low).set("high", exponents.high);
  chart.block("map", {hemisphere_rows(report, lobe, exponents)})
      .block("net", net(radii, 0.0, 360.0, 45.0))
      .block("rings", {labels})
      .block("marks", {{seen_from_above(lobe.theta_i.degrees(), 0.0)}});
  return figures.figure(
      chart,
      fmt::format("f_r in 1/sr over the hemisphere, light {}: polar angle outwards, mirror side to "
                  "the right; the ring marks the mirror direction",
                  lobe_words(report, lobe)),
      {});
}

}  // namespace

PageList in_plane_figures(Figures& figures, const ScanReport& report) {
  std::vector<Eigen::Index> positions;
  for (std::size_t k = 0; k < shown(report, most_lobes); ++k) {
    for (const Eigen::Index p : report.lobes[k].positions) {
      if (in_plane_deg(report.result.positions[std::size_t(p)])) {
        positions.push_back(p);
      }
    }
  }
  AxisSpan exponents = decades_of(report, positions);
  exponents = {std::floor(exponents.low), std::ceil(exponents.high)};
  std::vector<double> radii;
  Rows rings, spokes, incidence;
  const double decades = exponents.high - exponents.low;
  for (double k = 1.0; k <= decades; k += 1.0) {
    radii.push_back(k / decades);
    rings.push_back({k / decades, 0.0, exponents.low + k});
  }
  for (double angle = -90.0; angle <= 90.0; angle += 30.0) {
    spokes.push_back(on_circle(1.08, angle));
    spokes.back().push_back(std::abs(angle));
  }
  std::vector<Rows> curves;
  std::vector<std::string> keys;
  constexpr std::size_t least_points = 3;
  for (std::size_t k = 0; k < shown(report, most_lobes); ++k) {
    const ScanLobe& lobe = report.lobes[k];
    curves.push_back(in_plane_rows(report, lobe, exponents));
    if (curves.back().size() < least_points) {
      return {};
    }
    keys.push_back(lobe_words(report, lobe));
    incidence.push_back(on_circle(1.0, -lobe.theta_i.degrees()));
  }
  Chart chart("lobe_in_plane");
  chart.set("count", double(curves.size()))
      .block("curves", curves)
      .block("net", net(radii, -90.0, 90.0, 30.0))
      .block("rings", {rings})
      .block("spokes", {spokes})
      .block("incidence", {incidence});
  return {figures.figure(chart,
                         "f_r in 1/sr in the plane of measurement, on a logarithmic radius: the "
                         "source to the left, the mirror side to the right",
                         keys)};
}

PageList hemisphere_figures(Figures& figures, const ScanReport& report) {
  PageList list;
  for (std::size_t k = 0; k < shown(report, most_spheres); ++k) {
    if (report.lobes[k].hemispherical) {
      list.push_back(hemisphere_figure(figures, report, report.lobes[k]));
    }
  }
  return list;
}

PageList spectrum_figures(Figures& figures, const ScanReport& report) {
  const Eigen::ArrayXd& nanometres = report.plan.grid.nanometres();
  std::vector<Rows> curves;
  std::vector<std::string> keys;
  AxisSpan span = nothing_yet();
  for (std::size_t k = 0; k < shown(report, most_lobes); ++k) {
    const ScanLobe& lobe = report.lobes[k];
    Rows rows;
    for (Eigen::Index l = 0; l < nanometres.size(); ++l) {
      const double f_r = report.result.f_r(l, lobe.peak);
      rows.push_back({nanometres(l), f_r});
      span.include(f_r);
    }
    curves.push_back(rows);
    keys.push_back(lobe_words(report, lobe));
  }
  if (nanometres.size() < 2) {
    return {};
  }
  const AxisSpan values = finished(span, 0.02 * std::max(span.high, 1e-6));
  Chart chart("peak_spectra");
  chart.set("count", double(curves.size()))
      .set("x_low", nanometres(0))
      .set("x_high", nanometres(nanometres.size() - 1))
      .set("y_low", std::max(values.low, 0.0))
      .set("y_high", values.high)
      .block("curves", curves);
  return {figures.figure(chart, "f_r over wavelength at the peaks", keys)};
}

}  // namespace gonio

#include "reports/certificate_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/uncertainty_statement.hpp"
#include "reports/axis_span.hpp"
#include "reports/certificate_budget.hpp"
#include "reports/certificate_words.hpp"

namespace gonio {

namespace {

/// What a geometry states of one quantity.
const DeviationEffect* stated(const GeometryCertificate& geometry, const std::string& component) {
  const auto found =
      std::find_if(geometry.effects.begin(), geometry.effects.end(),
                   [&](const DeviationEffect& effect) { return effect.component == component; });
  return found == geometry.effects.end() ? nullptr : &*found;
}

using Value = std::optional<double> DeviationEffect::*;

std::optional<double> value_of(const GeometryCertificate& geometry, const std::string& component,
                               Value value) {
  const DeviationEffect* effect = stated(geometry, component);
  return effect == nullptr ? std::nullopt : effect->*value;
}

/// How far an axis lies from where it should be, in degrees.
double offset_of(const GeometryCertificate& geometry, const std::string& angle) {
  const DeviationEffect* effect = stated(geometry, angle);
  return effect == nullptr || !effect->nominal || !effect->as_built
             ? 0.0
             : *effect->as_built - *effect->nominal;
}

/// The edge of an opening, closed; empty if a size is not known.
Rows edge(const GeometryCertificate& geometry, const std::string& opening, Value value,
          double centre) {
  constexpr int corners = 72;
  Rows rows;
  if (const auto diameter = value_of(geometry, opening + "_diameter", value)) {
    for (int i = 0; i <= corners; ++i) {
      const double phi = 2.0 * std::numbers::pi * i / corners;
      rows.push_back({centre + 0.5 * *diameter * std::cos(phi), 0.5 * *diameter * std::sin(phi)});
    }
    return rows;
  }
  const auto in_plane = value_of(geometry, opening + "_in_plane", value);
  const auto perpendicular = value_of(geometry, opening + "_perpendicular", value);
  if (!in_plane || !perpendicular) {
    return rows;
  }
  const double x = 0.5 * *in_plane;
  const double y = 0.5 * *perpendicular;
  return {{centre - x, -y}, {centre + x, -y}, {centre + x, y}, {centre - x, y}, {centre - x, -y}};
}

AxisSpan span_of(const std::vector<Rows>& groups, std::size_t column) {
  AxisSpan span{0.0, 0.0};
  for (const Rows& rows : groups) {
    for (const std::vector<double>& row : rows) {
      span.include(row.at(column));
    }
  }
  constexpr double least_deg = 0.2;
  return span.at_least(least_deg).with_room();
}

/// Number of a component in budget.gnuplot; that of `another one` if it is none of them.
double number_of(const std::string& component) {
  const auto place_in = [&](const auto& names) {
    return std::size_t(std::find(names.begin(), names.end(), component) - names.begin());
  };
  const std::size_t quantity = place_in(setup_quantity_names);
  return quantity < setup_quantity_count
             ? double(quantity + 1)
             : double(setup_quantity_count + place_in(uncertainty_component_names) + 1);
}

/// Shares in %, by component; what is left out is small everywhere.
std::vector<std::map<std::string, double>> shares_of(const Certificate& certificate,
                                                     const GeometryCertificate& geometry,
                                                     const std::vector<ShownBudget>& shown) {
  std::vector<std::map<std::string, double>> shares;
  for (const ShownBudget& one : shown) {
    shares.emplace_back();
    for (const BudgetLine& line :
         budget_lines(certificate, geometry, geometry.readings.at(one.sample))) {
      shares.back()[line.input->component] += 100.0 * line.contribution->share;
    }
  }
  return shares;
}

/// The components with the largest shares, the largest first.
std::vector<std::string> largest_components(
    const std::vector<std::map<std::string, double>>& shares) {
  std::map<std::string, double> largest;
  for (const auto& of_sample : shares) {
    for (const auto& [component, share] : of_sample) {
      largest[component] = std::max(largest[component], std::abs(share));
    }
  }
  std::vector<std::string> components;
  for (const auto& [component, share] : largest) {
    constexpr double visible_percent = 0.05;
    if (share >= visible_percent) {
      components.push_back(component);
    }
  }
  std::stable_sort(components.begin(), components.end(),
                   [&](const auto& a, const auto& b) { return largest.at(a) > largest.at(b); });
  constexpr std::size_t most = 10;
  components.resize(std::min(most, components.size()));
  return components;
}

}  // namespace

bool has_openings(const GeometryCertificate& geometry) {
  const auto has = [&](const std::string& opening) {
    return !edge(geometry, opening, &DeviationEffect::nominal, 0.0).empty() ||
           !edge(geometry, opening, &DeviationEffect::as_built, 0.0).empty();
  };
  return has("receptor") || has("source");
}

PageData apertures_figure(Figures& figures, const GeometryCertificate& geometry) {
  std::vector<Rows> outlines;
  std::vector<Rows> bands;
  std::vector<std::string> keys;
  const auto add_opening = [&](const std::string& opening, const std::string& title,
                               double centre) {
    const auto add = [&](Value value, double at, const char* which) {
      if (const Rows rows = edge(geometry, opening, value, at); !rows.empty()) {
        outlines.push_back(rows);
        keys.push_back(fmt::format("{} {}", title, which));
      }
    };
    const Rows largest = edge(geometry, opening, &DeviationEffect::high, 0.0);
    const Rows smallest = edge(geometry, opening, &DeviationEffect::low, 0.0);
    if (!largest.empty() && !smallest.empty()) {
      bands.insert(bands.end(), {largest, smallest});
    }
    add(&DeviationEffect::nominal, 0.0, "by the standard");
    add(&DeviationEffect::as_built, centre, "as built");
  };
  add_opening("receptor", "receptor", offset_of(geometry, "theta_r"));
  add_opening("source", "image of the source", offset_of(geometry, "theta_i"));
  std::vector<Rows> all = outlines;
  all.insert(all.end(), bands.begin(), bands.end());
  const AxisSpan x = span_of(all, 0);
  const AxisSpan y = span_of(all, 1);
  Chart chart("apertures");
  chart.set("x_low", x.low).set("x_high", x.high).set("y_low", y.low).set("y_high", y.high);
  chart.set("count", double(outlines.size())).set("bands", double(bands.size()));
  chart.block("bands", bands).block("outlines", outlines);
  return figures.figure(
      chart,
      fmt::format("Geometry {}: openings as the receptor sees them, to scale. Shaded: between the "
                  "smallest and the largest size that the limits allow",
                  geometry.id),
      keys);
}

PageData deviation_figure(Figures& figures, const Certificate& certificate,
                          const GeometryCertificate& geometry) {
  Rows rows;
  AxisSpan y{0.0, 0.0};
  for (const CertifiedReading& reading : geometry.readings) {
    const double U = reading.propagated.expanded_uncertainty;
    rows.push_back({double(rows.size() + 1), reading.deviation_gu(), U});
    y.include(reading.deviation_gu() - U);
    y.include(reading.deviation_gu() + U);
  }
  y = y.or_unit().with_room();
  Chart chart("deviation");
  chart.set("y_low", y.low).set("y_high", y.high);
  chart.set("samples", double(std::max<std::size_t>(1, rows.size())));
  chart.block("readings", {rows});
  return figures.figure(
      chart,
      fmt::format("Geometry {}: deviation of the readings of the set-up as built from those of the "
                  "standard, by the number of the sample; bars and band: U for {:g} %. The axis is "
                  "logarithmic beyond 0.1 GU",
                  geometry.id, 100.0 * certificate.coverage),
      {});
}

PageData worst_case_figure(Figures& figures, const GeometryCertificate& geometry) {
  const DeviationEffect* all = stated(geometry, "all");
  Rows rows;
  AxisSpan y{0.0, 0.0};
  for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
    const double as_built =
        all != nullptr && i < all->as_built_gu.size() ? all->as_built_gu[i] : std::nan("");
    rows.push_back({double(i + 1), geometry.readings[i].lowest.change_gu,
                    geometry.readings[i].highest.change_gu, as_built});
    for (std::size_t column = 1; column < rows.back().size(); ++column) {
      y.include(rows.back()[column]);
    }
  }
  y = y.or_unit().with_room();
  Chart chart("worst_case");
  chart.set("y_low", y.low).set("y_high", y.high);
  chart.set("samples", double(std::max<std::size_t>(1, rows.size())));
  chart.block("changes", {rows});
  return figures.figure(
      chart,
      fmt::format("Geometry {}: boxes: by how much a reading can change while all angles and "
                  "openings keep within their limits; points: all deviations as built together",
                  geometry.id),
      {});
}

PageData budget_figure(Figures& figures, const Certificate& certificate,
                       const GeometryCertificate& geometry) {
  const auto shown = shown_budgets({.certificate = certificate}, geometry);
  const auto shares = shares_of(certificate, geometry, shown);
  const std::vector<std::string> components = largest_components(shares);
  std::vector<Rows> groups;
  AxisSpan x{0.0, 1.0};
  std::vector<std::string> keys;
  for (std::size_t s = 0; s < shown.size(); ++s) {
    groups.emplace_back();
    keys.push_back(
        fmt::format("{}, which {}", sample_title(certificate, shown[s].sample), shown[s].why));
    for (std::size_t i = 0; i < components.size(); ++i) {
      const auto found = shares[s].find(components[i]);
      const double share = found == shares[s].end() ? 0.0 : found->second;
      groups.back().push_back({double(i + 1), share, number_of(components[i])});
      x.include(share);
    }
  }
  const double room = 0.12 * (x.high - x.low);  // for the numbers at the ends of bars
  Chart chart("budget");
  chart.set("x_low", x.low - (x.low < 0.0 ? room : 0.0)).set("x_high", x.high + room);
  chart.set("count", double(groups.size()));
  chart.set("components", double(std::max<std::size_t>(1, components.size())));
  chart.block("shares", groups);
  return figures.figure(
      chart,
      fmt::format("Geometry {}: what makes readings uncertain, by share in the variance",
                  geometry.id),
      keys);
}

}  // namespace gonio

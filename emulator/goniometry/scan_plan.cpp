#include "emulator/goniometry/scan_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "emulator/core/quantity.hpp"
#include "emulator/instrument/instrument.hpp"

namespace gonio {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> split_at(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

/// What `first:last:step unit` stands for, in the base unit of the dimension.
std::optional<std::vector<double>> parse_steps(std::string_view text, Dimension dimension) {
  const auto parts = split_at(text, ':');
  const std::size_t unit = parts.back().find_last_of("0123456789.");
  if (parts.size() != 3 || unit == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view unit_text = parts.back().substr(unit + 1);
  const auto one = parse_quantity(fmt::format("1{}", unit_text), dimension);
  const auto first = parse_quantity(parts[0], Dimension::number);
  const auto last = parse_quantity(parts[1], Dimension::number);
  const auto step = parse_quantity(parts[2].substr(0, unit + 1), Dimension::number);
  if (!one || !first || !last || !step || !(*step > 0.0) || *last < *first) {
    return std::nullopt;
  }
  const double steps = (*last - *first) / *step;
  if (steps > ScanPlan::most_positions || std::abs(steps - std::round(steps)) > 1e-6) {
    return std::nullopt;
  }
  std::vector<double> values;
  for (int k = 0; k <= int(std::round(steps)); ++k) {
    values.push_back(*one * (*first + k * *step));
  }
  return values;
}

constexpr const char* expected_angles =
    "angles (deg, rad, mrad) in a list, or first:last:step with a unit, e.g. 0:80:5 deg, a whole "
    "number of steps";
constexpr const char* expected_opening =
    "full angles in (0, 120] deg, as 4.7 deg of a circle, 0.75 deg x 2.5 deg of a rectangle, or "
    "collimated";

std::vector<Angle> read_angles(const YamlNode& node, const Range& range_deg) {
  std::vector<Angle> angles;
  const auto read_one = [&](const YamlNode& item) {
    const auto found = parse_angles(item.text());
    if (!found) {
      item.fail(expected_angles);
    }
    for (const Angle angle : *found) {
      if (!range_deg.contains(angle.degrees())) {
        item.fail(fmt::format("angles{} deg", range_deg.text()));
      }
      angles.push_back(angle);
    }
  };
  if (node.is_list()) {
    for (const YamlNode& item : node.list()) {
      read_one(item);
    }
  } else {
    read_one(node);
  }
  return angles;
}

ScanOpening read_opening(const YamlNode& node, const ScanPlan& plan) {
  if (plan.instrument) {
    node.fail("no aperture beside those of the instrument");
  }
  const auto opening = parse_opening(node.text());
  if (!opening) {
    node.fail(expected_opening);
  }
  return *opening;
}

void read_source(const YamlNode& node, ScanPlan& plan) {
  node.read_map([&](YamlMap& map) {
    plan.theta_i = read_angles(map.required("theta"), ScanPlan::range_theta_i());
    if (const auto aperture = map.optional("aperture")) {
      plan.source = read_opening(*aperture, plan);
    }
    if (const auto spectrum = map.optional("spectrum")) {
      plan.spectrum = spectrum->file();
    }
    return true;
  });
}

void read_receptor(const YamlNode& node, ScanPlan& plan) {
  node.read_map([&](YamlMap& map) {
    plan.theta_r = read_angles(map.required("theta"), ScanPlan::range_theta_r());
    if (const auto azimuth = map.optional("azimuth")) {
      plan.phi_r = read_angles(*azimuth, ScanPlan::range_azimuth());
    }
    if (const auto aperture = map.optional("aperture")) {
      plan.receptor = read_opening(*aperture, plan);
    }
    return true;
  });
}

void read_integrator(YamlMap& map, ScanPlan& plan) {
  if (const auto integrator = map.optional("integrator")) {
    plan.integrator = integrator->choice({"aperture", "patches"}) == "patches"
                          ? ScanIntegrator::patches
                          : ScanIntegrator::aperture;
  }
  if (const auto patches = map.optional("patches")) {
    plan.patches = patches->integer(4, 4096);
    if (plan.patches % 4 != 0 || plan.integrator != ScanIntegrator::patches) {
      patches->fail("a multiple of 4, with integrator: patches");
    }
  }
  if (const auto tolerance = map.optional("tolerance")) {
    plan.tolerance = tolerance->number(ScanPlan::range_tolerance());
  }
}

void read_instrument(YamlMap& map, ScanPlan& plan, const Catalog& catalog) {
  const auto instrument = map.optional("instrument");
  const auto geometry = map.optional("geometry");
  if (!instrument) {
    if (geometry) {
      geometry->fail("an instrument, whose geometry it is");
    }
    return;
  }
  const YamlNode id = map.required("geometry");
  try {
    take_apertures(plan, catalog.find(Catalog::Kind::instrument, *instrument), id.text(), catalog);
  } catch (const std::invalid_argument& error) {
    id.fail("a geometry of the instrument");
  }
}

ScanOpening opening_of(const Aperture& aperture) {
  const auto full = [](double half_size) { return radians(2.0 * std::atan(half_size)); };
  return {.outline = aperture.outline(),
          .in_plane = full(aperture.u_high()),
          .perpendicular = full(aperture.v_high())};
}

}  // namespace

std::vector<ScanPosition> ScanPlan::positions() const {
  std::vector<Angle> receptor_polar = theta_r;
  for (int theta_deg = -85; theta_r.empty() && theta_deg <= 85; ++theta_deg) {
    receptor_polar.push_back(degrees(theta_deg));
  }
  const double count = double(theta_i.size()) * double(receptor_polar.size()) *
                       double(phi_r.size()) * double(rotation.size());
  if (count > most_positions || count * double(grid.size()) > most_numbers) {
    throw std::invalid_argument(fmt::format(
        "a scan may hold {:.0f} positions, and {:.0f} positions times wavelengths; {:.0f} "
        "positions at {} wavelengths were asked for",
        most_positions, most_numbers, count, grid.size()));
  }
  std::vector<ScanPosition> positions;
  for (const Angle turn : rotation) {
    for (const Angle from : theta_i) {
      for (const Angle azimuth : phi_r) {
        for (const Angle to : receptor_polar) {
          if (to != Angle{} || azimuth == phi_r.front()) {
            positions.push_back(
                {.theta_i = from, .theta_r = to, .phi_r = azimuth, .rotation = turn});
          }
        }
      }
    }
  }
  return positions;
}

std::optional<std::vector<Angle>> parse_angles(std::string_view text) {
  std::vector<Angle> angles;
  for (const std::string_view part : split_at(text, ',')) {
    if (const auto one = parse_quantity(part, Dimension::angle)) {
      angles.push_back(radians(*one));
    } else if (const auto steps = parse_steps(part, Dimension::angle)) {
      for (const double value : *steps) {
        angles.push_back(radians(value));
      }
    } else {
      return std::nullopt;
    }
  }
  return angles;
}

std::optional<ScanOpening> parse_opening(std::string_view text) {
  if (trimmed(text) == "collimated") {
    return ScanOpening{};
  }
  std::vector<Angle> sides;
  for (const std::string_view part : split_at(text, 'x')) {
    const auto side = parse_quantity(part, Dimension::angle);
    if (!side ||
        !Range{.low = 0.0, .high = 120.0, .low_open = true}.contains(radians(*side).degrees())) {
      return std::nullopt;
    }
    sides.push_back(radians(*side));
  }
  if (sides.size() > 2) {
    return std::nullopt;
  }
  return ScanOpening{
      .outline = sides.size() == 1 ? Aperture::Outline::circle : Aperture::Outline::rectangle,
      .in_plane = sides.front(),
      .perpendicular = sides.back()};
}

std::optional<WavelengthGrid> parse_wavelength_grid(std::string_view text) {
  const auto steps = parse_steps(text, Dimension::length);
  if (!steps || !(steps->front() > 0.0) || steps->size() > 10'000) {
    return std::nullopt;
  }
  const double step = steps->size() > 1 ? (*steps)[1] - steps->front() : 1.0;
  return WavelengthGrid(nanometres(steps->front()), nanometres(step), Eigen::Index(steps->size()));
}

void take_apertures(ScanPlan& plan, const std::filesystem::path& instrument,
                    const std::string& geometry, const Catalog& catalog) {
  const Instrument device = load_instrument(instrument, catalog);
  if (!device.has(geometry)) {
    throw std::invalid_argument(fmt::format("{} has no geometry '{}'", device.id, geometry));
  }
  const MeasuringGeometry apertures = device.geometry(geometry);
  plan.source = opening_of(apertures.source);
  plan.receptor = opening_of(apertures.receptor);
  plan.instrument = fmt::format("{}, geometry {}", device.id, geometry);
}

ScanPlan load_scan_plan(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/scan/1");
    ScanPlan plan{.id = map.required("id").id(), .title = map.required("title").line()};
    if (const auto notes = map.optional("notes")) {
      plan.notes = notes->line();
    }
    read_instrument(map, plan, catalog);
    read_source(map.required("source"), plan);
    read_receptor(map.required("receptor"), plan);
    if (const auto rotation = map.optional("rotation")) {
      plan.rotation = read_angles(*rotation, ScanPlan::range_azimuth());
    }
    if (const auto wavelengths = map.optional("wavelengths")) {
      const auto grid = parse_wavelength_grid(wavelengths->text());
      if (!grid) {
        wavelengths->fail("first:last:step nm, a whole number of steps");
      }
      plan.grid = *grid;
    }
    read_integrator(map, plan);
    if (const auto apart = map.optional("heads_apart")) {
      plan.heads_apart = apart->angle(Range::closed(0.0, 90.0));
    }
    if (const auto reciprocity = map.optional("reciprocity")) {
      const std::string use = reciprocity->choice({"automatic", "yes", "no"});
      plan.reciprocity = use == "automatic" ? UseOfReciprocity::automatic
                         : use == "yes"     ? UseOfReciprocity::yes
                                            : UseOfReciprocity::no;
    }
    return plan;
  });
}

}  // namespace gonio

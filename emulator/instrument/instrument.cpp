#include "emulator/instrument/instrument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>

#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/overlay.hpp"

namespace gonio {

namespace {

std::vector<std::string> ids_of(const Standard& standard) {
  std::vector<std::string> ids;
  for (const GeometryLimits& geometry : standard.geometries) {
    ids.push_back(geometry.id);
  }
  return ids;
}

/// The geometries that an instrument has, in the order of its standard.
std::vector<std::string> read_geometries(const YamlNode& node, const Standard& standard) {
  const std::vector<std::string> known = ids_of(standard);
  std::set<std::string> listed;
  for (const YamlNode& item : node.list()) {
    const std::string id = item.choice(known);
    if (!listed.insert(id).second) {
      item.fail("each geometry once");
    }
  }
  for (const std::string& id : listed) {
    const auto& needed = standard.geometry(id).relative_to;
    if (needed && !listed.contains(*needed)) {
      node.fail(fmt::format("'{}' too, where the reference of '{}' is read", *needed, id), "none");
    }
  }
  std::vector<std::string> ids;
  std::copy_if(known.begin(), known.end(), std::back_inserter(ids),
               [&](const std::string& id) { return listed.contains(id); });
  return ids;
}

/// A rectangle in place of the standard's circle needs both its sides.
void expect_both_sides(const OpeningAsBuilt& opening) {
  if (opening.in_plane && opening.perpendicular) {
    return;
  }
  const std::string there = opening.in_plane ? "in_plane" : "perpendicular";
  const std::string missing = opening.in_plane ? "perpendicular" : "in_plane";
  SourceMark mark = opening.mark;
  mark.key += "." + missing;
  throw InputError(mark, fmt::format("the key '{}', since the standard has a circle", missing),
                   "only " + there);
}

Aperture build(const Frame& frame, const ApertureLimits& limits, const OpeningAsBuilt& opening) {
  if (opening.diameter) {
    return Aperture::circle(frame, opening.diameter->value);
  }
  if (limits.is_sphere && !limits.is_circle()) {
    return Aperture::circle(frame, Angle());  // no gloss trap
  }
  if (limits.is_circle() && !opening.in_plane && !opening.perpendicular) {
    return Aperture::circle(frame, limits.diameter->known().nominal);
  }
  if (limits.is_circle()) {
    expect_both_sides(opening);
  }
  const Angle in_plane =
      opening.in_plane ? opening.in_plane->value : limits.in_plane->known().nominal;
  const Angle perpendicular =
      opening.perpendicular ? opening.perpendicular->value : limits.perpendicular->known().nominal;
  return Aperture::rectangle(frame, in_plane, perpendicular);
}

}  // namespace

Angle Instrument::angle_of_incidence(const std::string& geometry_id) const {
  if (!has(geometry_id)) {
    throw std::out_of_range(fmt::format("Instrument::geometry: {} has no '{}'", id, geometry_id));
  }
  const auto found = as_built.find(geometry_id);
  return found != as_built.end() && found->second.theta_i
             ? found->second.theta_i->value
             : standard.geometry(geometry_id).theta_i.nominal;
}

Spot Instrument::spot(const std::string& geometry_id, double x_mm, double y_mm) const {
  const double cos_theta_i = std::cos(angle_of_incidence(geometry_id).radians());
  const auto found = beam.find(geometry_id);
  const BeamSection section = found == beam.end() ? BeamSection{} : found->second;
  return {.x_mm = x_mm,
          .y_mm = y_mm,
          .half_length_mm = 0.5 * section.in_plane_mm / cos_theta_i,
          .half_width_mm = 0.5 * section.perpendicular_mm};
}

MeasuringGeometry Instrument::geometry(const std::string& geometry_id) const {
  const Angle theta_i = angle_of_incidence(geometry_id);
  const GeometryLimits& limits = standard.geometry(geometry_id);
  const auto found = as_built.find(geometry_id);
  const GeometryAsBuilt built = found == as_built.end() ? GeometryAsBuilt{} : found->second;
  const Angle theta_r = built.theta_r ? built.theta_r->value : limits.receptor_angle();
  return {.source = build(source_frame(theta_i), limits.source, built.source),
          .receptor = build(receptor_frame(theta_r), limits.receptor, built.receptor)};
}

bool Instrument::has(const std::string& geometry_id) const {
  return std::find(geometries.begin(), geometries.end(), geometry_id) != geometries.end();
}

Instrument nominal_instrument(const Standard& standard) {
  return {.file = {},
          .id = "nominal",
          .title = "Nominal values of " + standard.id,
          .standard = standard,
          .geometries = ids_of(standard),
          .source = standard.source,
          .responsivity = standard.responsivity};
}

void expect_gloss(const Instrument& instrument) {
  if (instrument.standard.scale.is_of_colour()) {
    throw std::invalid_argument(
        fmt::format("expected an instrument that measures gloss, found '{}', which measures colour "
                    "by {}: see gonio colour",
                    instrument.file.empty() ? instrument.title : instrument.id,
                    instrument.standard.id));
  }
}

Instrument load_instrument(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/instrument/1");
    const YamlNode built_to = map.required("built_to");
    Instrument instrument =
        nominal_instrument(load_standard(catalog.find(Catalog::Kind::standard, built_to), catalog));
    instrument.file = path;
    instrument.id = map.required("id").id();
    instrument.title = map.required("title").line();
    if (const auto notes = map.optional("notes")) {
      instrument.notes = notes->text();
    }
    if (const auto geometries = map.optional("geometries")) {
      instrument.geometries = read_geometries(*geometries, instrument.standard);
    }
    if (const auto identity = map.optional("identity")) {
      instrument.identity = read_identity(*identity);
    }
    read_overlay(map, instrument, catalog);
    instrument.wire = map.optional("wire");
    return instrument;
  });
}

}  // namespace gonio

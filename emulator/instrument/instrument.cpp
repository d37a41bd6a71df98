#include "emulator/instrument/instrument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

OpeningAsBuilt read_opening(const YamlNode& node) {
  const Range range = Range::closed(0.0, 120.0);
  return node.read_map([&](YamlMap& map) {
    OpeningAsBuilt opening{.mark = node.mark()};
    if (const auto diameter = map.optional("diameter")) {
      opening.diameter = diameter->angle(range);
      return opening;
    }
    if (const auto in_plane = map.optional("in_plane")) {
      opening.in_plane = in_plane->angle(range);
    }
    if (const auto perpendicular = map.optional("perpendicular")) {
      opening.perpendicular = perpendicular->angle(range);
    }
    return opening;
  });
}

GeometryAsBuilt read_geometry(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    GeometryAsBuilt geometry{.mark = node.mark()};
    if (const auto theta_i = map.optional("theta_i")) {
      geometry.theta_i = theta_i->angle({.low = 0.0, .high = 90.0, .high_open = true});
    }
    if (const auto theta_r = map.optional("theta_r")) {
      geometry.theta_r = theta_r->angle({.low = -90.0, .high = 90.0});
    }
    if (const auto source = map.optional("source")) {
      geometry.source = read_opening(*source);
    }
    if (const auto receptor = map.optional("receptor")) {
      geometry.receptor = read_opening(*receptor);
    }
    return geometry;
  });
}

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

std::map<std::string, GeometryAsBuilt> read_as_built(const YamlNode& node,
                                                     const Instrument& instrument) {
  std::map<std::string, GeometryAsBuilt> as_built;
  const std::vector<std::string> known = ids_of(instrument.standard);
  node.for_each_entry([&](const std::string& id, const YamlNode& geometry) {
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      geometry.fail("a geometry of " + instrument.standard.id, id);
    }
    if (!instrument.has(id)) {
      geometry.fail("one of the geometries of this instrument", id);
    }
    as_built.emplace(id, read_geometry(geometry));
  });
  return as_built;
}

std::vector<std::filesystem::path> read_samples(const YamlNode& node, const Catalog& catalog) {
  std::vector<std::filesystem::path> files;
  for (const YamlNode& item : node.list()) {
    files.push_back(catalog.find(Catalog::Kind::sample, item));
  }
  return files;
}

void read_optics(YamlMap& map, Instrument& instrument) {
  if (const auto geometries = map.optional("geometries")) {
    instrument.geometries = read_geometries(*geometries, instrument.standard);
  }
  if (const auto as_built = map.optional("as_built")) {
    instrument.as_built = read_as_built(*as_built, instrument);
  }
  if (const auto source = map.optional("source_spectrum")) {
    instrument.source = SpectralTable::load(*source);
  }
  if (const auto responsivity = map.optional("responsivity")) {
    instrument.responsivity = SpectralTable::load(*responsivity);
  }
}

void read_device(YamlMap& map, Instrument& instrument) {
  if (const auto identity = map.optional("identity")) {
    instrument.identity = read_identity(*identity);
  }
  if (const auto behaviour = map.optional("behaviour")) {
    instrument.behaviour = read_behaviour(*behaviour, instrument.geometries);
  }
  if (const auto repeatability = map.optional("repeatability")) {
    instrument.behaviour.repeatability_gu = repeatability->gloss_gu(Range::not_negative());
  }
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
    return Aperture::circle(frame, *opening.diameter);
  }
  if (limits.is_circle() && !opening.in_plane && !opening.perpendicular) {
    return Aperture::circle(frame, limits.diameter->known().nominal);
  }
  if (limits.is_circle()) {
    expect_both_sides(opening);
  }
  const Angle in_plane = opening.in_plane ? *opening.in_plane : limits.in_plane->known().nominal;
  const Angle perpendicular =
      opening.perpendicular ? *opening.perpendicular : limits.perpendicular->known().nominal;
  return Aperture::rectangle(frame, in_plane, perpendicular);
}

}  // namespace

MeasuringGeometry Instrument::geometry(const std::string& geometry_id) const {
  if (!has(geometry_id)) {
    throw std::out_of_range(fmt::format("Instrument::geometry: {} has no '{}'", id, geometry_id));
  }
  const GeometryLimits& limits = standard.geometry(geometry_id);
  const auto found = as_built.find(geometry_id);
  const GeometryAsBuilt built = found == as_built.end() ? GeometryAsBuilt{} : found->second;
  return {.source = build(source_frame(built.theta_i.value_or(limits.theta_i.nominal)),
                          limits.source, built.source),
          .receptor = build(receptor_frame(built.theta_r.value_or(limits.receptor_angle())),
                            limits.receptor, built.receptor)};
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
    read_optics(map, instrument);
    read_device(map, instrument);
    if (const auto samples = map.optional("samples")) {
      instrument.samples = read_samples(*samples, catalog);
    }
    instrument.wire = map.optional("wire");
    return instrument;
  });
}

}  // namespace gonio

#include "emulator/instrument/instrument.hpp"

#include <fmt/format.h>

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
  const GeometryLimits& limits = standard.geometry(geometry_id);
  const auto found = as_built.find(geometry_id);
  const GeometryAsBuilt built = found == as_built.end() ? GeometryAsBuilt{} : found->second;
  return {.source = build(source_frame(built.theta_i.value_or(limits.theta_i.nominal)),
                          limits.source, built.source),
          .receptor = build(receptor_frame(built.theta_r.value_or(limits.receptor_angle())),
                            limits.receptor, built.receptor)};
}

Instrument nominal_instrument(const Standard& standard) {
  return {.file = {},
          .id = "nominal",
          .title = "Nominal values of " + standard.id,
          .standard = standard,
          .source = standard.source,
          .responsivity = standard.responsivity};
}

Instrument load_instrument(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/instrument/1");
    const YamlNode built_to = map.required("built_to");
    const Standard standard =
        load_standard(catalog.find(Catalog::Kind::standard, built_to), catalog);
    Instrument instrument = nominal_instrument(standard);
    instrument.file = path;
    instrument.id = map.required("id").id();
    instrument.title = map.required("title").line();
    if (const auto notes = map.optional("notes")) {
      instrument.notes = notes->text();
    }
    if (const auto source = map.optional("source_spectrum")) {
      instrument.source = SpectralTable::load(*source);
    }
    if (const auto responsivity = map.optional("responsivity")) {
      instrument.responsivity = SpectralTable::load(*responsivity);
    }
    if (const auto repeatability = map.optional("repeatability")) {
      instrument.repeatability_gu = repeatability->gloss_gu(Range::not_negative());
    }
    if (const auto as_built = map.optional("as_built")) {
      as_built->for_each_entry([&](const std::string& id, const YamlNode& node) {
        bool known = false;
        for (const GeometryLimits& geometry : standard.geometries) {
          known = known || geometry.id == id;
        }
        if (!known) {
          node.fail("a geometry of " + standard.id, id);
        }
        instrument.as_built.emplace(id, read_geometry(node));
      });
    }
    return instrument;
  });
}

}  // namespace gonio

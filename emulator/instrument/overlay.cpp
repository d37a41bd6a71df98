#include "emulator/instrument/overlay.hpp"

#include <algorithm>
#include <utility>

namespace gonio {

namespace {

/// `60.04 deg`, or `{value: 60.04 deg, expanded_uncertainty: 0.02 deg}`.
AngleAsBuilt read_angle(const YamlNode& node, const Range& range) {
  if (!node.is_map()) {
    return {.value = node.angle(range)};
  }
  return node.read_map([&](YamlMap& map) {
    return AngleAsBuilt{
        .value = map.required("value").angle(range),
        .expanded_uncertainty = map.required("expanded_uncertainty").angle(Range::not_negative())};
  });
}

SetupUncertainty read_setup_uncertainty(const YamlNode& node, SetupUncertainty uncertainty) {
  return node.read_map([&](YamlMap& map) {
    if (const auto angles = map.optional("angles")) {
      uncertainty.angles = angles->angle(Range::not_negative());
    }
    if (const auto apertures = map.optional("apertures")) {
      uncertainty.apertures = apertures->angle(Range::not_negative());
    }
    return uncertainty;
  });
}

/// A size of the one shape takes the place of all sizes of the other.
OpeningAsBuilt read_opening(const YamlNode& node, OpeningAsBuilt opening) {
  const Range range = Range::closed(0.0, 120.0);
  return node.read_map([&](YamlMap& map) {
    opening.mark = node.mark();
    if (const auto diameter = map.optional("diameter")) {
      return OpeningAsBuilt{.diameter = read_angle(*diameter, range), .mark = node.mark()};
    }
    if (const auto in_plane = map.optional("in_plane")) {
      opening.diameter.reset();
      opening.in_plane = read_angle(*in_plane, range);
    }
    if (const auto perpendicular = map.optional("perpendicular")) {
      opening.diameter.reset();
      opening.perpendicular = read_angle(*perpendicular, range);
    }
    return opening;
  });
}

GeometryAsBuilt read_geometry(const YamlNode& node, GeometryAsBuilt geometry) {
  return node.read_map([&](YamlMap& map) {
    geometry.mark = node.mark();
    if (const auto theta_i = map.optional("theta_i")) {
      geometry.theta_i = read_angle(*theta_i, {.low = 0.0, .high = 90.0, .high_open = true});
    }
    if (const auto theta_r = map.optional("theta_r")) {
      geometry.theta_r = read_angle(*theta_r, {.low = -90.0, .high = 90.0});
    }
    if (const auto source = map.optional("source")) {
      geometry.source = read_opening(*source, geometry.source);
    }
    if (const auto receptor = map.optional("receptor")) {
      geometry.receptor = read_opening(*receptor, geometry.receptor);
    }
    return geometry;
  });
}

/// @param node  where the geometry's name stands for what belongs to it.
void expect_geometry(const Instrument& instrument, const std::string& id, const YamlNode& node) {
  const std::vector<GeometryLimits>& known = instrument.standard.geometries;
  if (std::none_of(known.begin(), known.end(),
                   [&](const GeometryLimits& limits) { return limits.id == id; })) {
    node.fail("a geometry of " + instrument.standard.id, id);
  }
  if (!instrument.has(id)) {
    node.fail("one of the geometries of this instrument", id);
  }
}

void read_as_built(const YamlNode& node, Instrument& instrument) {
  node.for_each_entry([&](const std::string& id, const YamlNode& geometry) {
    expect_geometry(instrument, id, geometry);
    GeometryAsBuilt& built = instrument.as_built[id];
    built = read_geometry(geometry, built);
  });
}

/// One number for all geometries, or a number by geometry.
void read_polarization(const YamlNode& node, Instrument& instrument) {
  const Range range = Range::closed(-1.0, 1.0);
  if (!node.is_map()) {
    const double of_all = node.number(range);
    for (const std::string& id : instrument.geometries) {
      instrument.polarization[id] = of_all;
    }
    return;
  }
  node.for_each_entry([&](const std::string& id, const YamlNode& value) {
    expect_geometry(instrument, id, value);
    instrument.polarization[id] = value.number(range);
  });
}

/// `{diameter: 9 mm}`, or `{in_plane: 9 mm, perpendicular: 12 mm}`.
BeamSection read_beam_section(const YamlNode& node) {
  const auto millimetres = [](const YamlNode& size) {
    constexpr double per_nanometre = 1e-6;
    return size.length(Range::positive()).nanometres() * per_nanometre;
  };
  return node.read_map([&](YamlMap& map) {
    if (const auto diameter = map.optional("diameter")) {
      const double both = millimetres(*diameter);
      return BeamSection{.in_plane_mm = both, .perpendicular_mm = both};
    }
    return BeamSection{.in_plane_mm = millimetres(map.required("in_plane")),
                       .perpendicular_mm = millimetres(map.required("perpendicular"))};
  });
}

/// One beam for all geometries, or one by geometry.
void read_spot(const YamlNode& node, Instrument& instrument) {
  bool by_geometry = false;
  node.for_each_entry([&](const std::string&, const YamlNode& value) {
    by_geometry = by_geometry || value.is_map();
  });
  if (!by_geometry) {
    for (const std::string& id : instrument.geometries) {
      instrument.beam[id] = read_beam_section(node);
    }
    return;
  }
  node.for_each_entry([&](const std::string& id, const YamlNode& value) {
    expect_geometry(instrument, id, value);
    instrument.beam[id] = read_beam_section(value);
  });
}

std::vector<std::filesystem::path> read_samples(const YamlNode& node, const Catalog& catalog) {
  std::vector<std::filesystem::path> files;
  for (const YamlNode& item : node.list()) {
    files.push_back(catalog.find(Catalog::Kind::sample, item));
  }
  return files;
}

void read_optics(YamlMap& map, Instrument& instrument) {
  if (const auto as_built = map.optional("as_built")) {
    read_as_built(*as_built, instrument);
  }
  if (const auto uncertainty = map.optional("setup_uncertainty")) {
    instrument.setup_uncertainty =
        read_setup_uncertainty(*uncertainty, instrument.setup_uncertainty);
  }
  if (const auto uncertainty = map.optional("uncertainty")) {
    instrument.uncertainty =
        read_uncertainty(*uncertainty, instrument.geometries,
                         std::move(instrument.uncertainty).value_or(UncertaintyStatement()));
  }
  if (const auto polarization = map.optional("polarization")) {
    read_polarization(*polarization, instrument);
  }
  if (const auto spot = map.optional("spot")) {
    read_spot(*spot, instrument);
  }
  if (const auto source = map.optional("source_spectrum")) {
    instrument.source = SpectralTable::load(*source);
  }
  if (const auto responsivity = map.optional("responsivity")) {
    instrument.responsivity = SpectralTable::load(*responsivity);
  }
}

}  // namespace

void read_overlay(YamlMap& map, Instrument& instrument, const Catalog& catalog) {
  read_optics(map, instrument);
  if (const auto behaviour = map.optional("behaviour")) {
    instrument.behaviour =
        read_behaviour(*behaviour, instrument.geometries, std::move(instrument.behaviour));
  }
  if (const auto repeatability = map.optional("repeatability")) {
    instrument.behaviour.repeatability_gu = repeatability->gloss_gu(Range::not_negative());
  }
  if (const auto samples = map.optional("samples")) {
    instrument.samples = read_samples(*samples, catalog);
  }
}

Instrument with_overlay(Instrument instrument, const YamlNode& overlay, const Catalog& catalog) {
  return overlay.read_map([&](YamlMap& map) {
    read_overlay(map, instrument, catalog);
    return std::move(instrument);
  });
}

}  // namespace gonio

#include "emulator/standard/standard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

/// Largest refractive index of a reference: above it nothing can be computed.
constexpr double largest_index = 1000.0;

Range opening_range() { return {.low = 0.0, .high = 120.0, .low_open = true}; }
Range incidence_range() { return {.low = 0.0, .high = 90.0, .high_open = true}; }

Stated<Angle> read_angle(const YamlNode& node, const Range& range) {
  return read_stated<Angle>(node, [&](const YamlNode& value, bool is_tolerance) {
    return value.angle(is_tolerance ? Range::positive() : range);
  });
}

Stated<Wavelength> read_wavelength(const YamlNode& node) {
  return read_stated<Wavelength>(
      node, [](const YamlNode& value, bool) { return value.length(Range::positive()); });
}

ApertureSize read_size(const YamlNode& node) {
  if (node.is_scalar() && node.text() == "unknown") {
    return {.value = std::nullopt, .mark = node.mark()};
  }
  return {.value = read_angle(node, opening_range()), .mark = node.mark()};
}

ApertureLimits read_source(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    ApertureLimits limits;
    if (const auto diameter = map.optional("diameter")) {
      limits.diameter = read_size(*diameter);
      return limits;
    }
    limits.in_plane = read_size(map.required("in_plane"));
    limits.perpendicular = read_size(map.required("perpendicular"));
    return limits;
  });
}

/// As a source, or an integrating sphere: `{collects: hemisphere}`, `{..., trap: 8 deg}`.
ApertureLimits read_receptor(const YamlNode& node) {
  if (!node.is_map() || !YamlMap(node).has("collects")) {
    return read_source(node);
  }
  return node.read_map([](YamlMap& map) {
    (void)map.required("collects").choice({"hemisphere"});
    ApertureLimits limits{.in_plane = {}, .perpendicular = {}, .diameter = {}, .is_sphere = true};
    if (const auto trap = map.optional("trap")) {
      limits.diameter = read_size(*trap);
    }
    return limits;
  });
}

/// Where standards are looked up, and those being read: each borrows from the next.
struct Library {
  const Catalog& catalog;
  std::vector<fs::path> being_read = {};
};

Standard load_from(const fs::path& path, Library library);

/// The file of a standard that another one borrows from: <family>/<edition> in the same folder, or
/// as the catalog knows it.
fs::path borrowed_file(const YamlNode& node, const Library& library) {
  const fs::path folder = fs::path(node.mark().file).parent_path();
  const fs::path sibling =
      (folder / ".." / ".." / node.text() / "standard.yaml").lexically_normal();
  std::error_code error;
  fs::path file = fs::is_regular_file(sibling, error)
                      ? sibling
                      : library.catalog.find(Catalog::Kind::standard, node);
  for (const fs::path& borrower : library.being_read) {
    if (fs::equivalent(borrower, file)) {
      node.fail("a standard that does not borrow from this one");
    }
  }
  return file;
}

/// A geometry of another standard.
GeometryLimits read_same_as(const YamlNode& node, const std::string& id, const Library& library) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode other = map.required("standard");
    const YamlNode geometry = map.required("geometry");
    const Standard standard = load_from(borrowed_file(other, library), library);
    for (const GeometryLimits& candidate : standard.geometries) {
      if (candidate.id == geometry.text()) {
        GeometryLimits result = candidate;
        result.id = id;
        return result;
      }
    }
    geometry.fail("a geometry of " + standard.id);
  });
}

GeometryLimits read_geometry(const YamlNode& node, const Library& library) {
  return node.read_map([&](YamlMap& map) {
    const std::string id = map.required("id").line();
    if (const auto same_as = map.optional("same_as")) {
      return read_same_as(*same_as, id, library);
    }
    GeometryLimits limits{.id = id,
                          .theta_i = read_angle(map.required("theta_i"), incidence_range()),
                          .theta_r = {},
                          .source = {},
                          .receptor = {},
                          .relative_to = {},
                          .mark = node.mark()};
    if (const auto theta_r = map.optional("theta_r")) {
      limits.theta_r = read_angle(*theta_r, {.low = -90.0, .high = 90.0});
    }
    limits.source = read_source(map.required("source"));
    limits.receptor = read_receptor(map.required("receptor"));
    if (const auto relative_to = map.optional("relative_to")) {
      limits.relative_to = relative_to->text();
    }
    return limits;
  });
}

Scale::Reference read_reference(const YamlNode& node) {
  const std::string name = node.choice({"reference_glass", "incident_flux", "perfect_diffuser"});
  return name == "reference_glass" ? Scale::Reference::glass
         : name == "incident_flux" ? Scale::Reference::incident_flux
                                   : Scale::Reference::perfect_diffuser;
}

Scale read_scale(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    const std::string unit = map.required("unit").line();
    const Scale::Reference reference = read_reference(map.required("relative_to"));
    Scale scale{
        .unit = unit, .reference = reference, .value = read_stated_number(map.required("value"))};
    if (reference == Scale::Reference::glass) {
      scale.refractive_index = read_stated_number(
          map.required("refractive_index"), {.low = 0.0, .high = largest_index, .low_open = true});
      if (const auto wavelength = map.optional("reference_wavelength")) {
        scale.reference_wavelength = read_wavelength(*wavelength);
      }
    }
    return scale;
  });
}

/// `{file: ..., column: ..., evidence: ...}`.
SpectralTable read_spectrum(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    const auto column = map.optional("column");
    (void)read_evidence(map.required("evidence"));
    return SpectralTable::load(map.required("file").file(),
                               column ? std::optional(column->text()) : std::nullopt);
  });
}

Selection read_selection(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    Selection selection{.first = map.required("first").text(), .rules = {}};
    for (const YamlNode& item : map.required("rules").list()) {
      selection.rules.push_back(item.read_map([](YamlMap& rule) {
        SelectionRule result{.geometry = rule.required("geometry").text(),
                             .when_above = {},
                             .when_below = {},
                             .evidence = read_evidence(rule.required("evidence"))};
        if (const auto above = rule.optional("when_above")) {
          result.when_above = above->gloss_gu();
        } else {
          result.when_below = rule.required("when_below").gloss_gu();
        }
        return result;
      }));
    }
    return selection;
  });
}

HazeRule read_haze(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    HazeRule rule{.id = map.required("id").line(),
                  .from = map.required("from").text(),
                  .minus = map.required("minus").text(),
                  .only_above = {},
                  .evidence = read_evidence(map.required("evidence"))};
    if (const auto above = map.optional("only_above")) {
      rule.only_above = above->gloss_gu();
    }
    return rule;
  });
}

/// The ids that rules name must be geometries of the standard.
void expect_geometries(const Standard& standard, const YamlNode& node) {
  std::vector<std::string> known;
  for (const GeometryLimits& geometry : standard.geometries) {
    if (std::find(known.begin(), known.end(), geometry.id) != known.end()) {
      throw InputError(geometry.mark, "each geometry once", geometry.id);
    }
    known.push_back(geometry.id);
  }
  const auto expect = [&](const std::string& id) {
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      node.fail(fmt::format("names of the geometries {}", fmt::join(known, ", ")), id);
    }
  };
  for (const GeometryLimits& geometry : standard.geometries) {
    expect(geometry.relative_to.value_or(geometry.id));
  }
  if (standard.selection) {
    expect(standard.selection->first);
    for (const SelectionRule& rule : standard.selection->rules) {
      expect(rule.geometry);
    }
  }
  for (const HazeRule& rule : standard.haze) {
    expect(rule.from);
    expect(rule.minus);
  }
  if (standard.flop) {
    expect(standard.flop->near_specular);
    expect(standard.flop->face);
    expect(standard.flop->far);
  }
}

Standard read_standard(YamlMap& map, const fs::path& path, const Library& library) {
  map.expect_schema("gonio/standard/1");
  std::optional<SpectralTable> source;
  std::optional<SpectralTable> responsivity;
  map.required("spectral").read_map([&](YamlMap& spectral) {
    source = read_spectrum(spectral.required("source"));
    responsivity = read_spectrum(spectral.required("responsivity"));
    return true;
  });
  Standard standard{.file = path,
                    .id = map.required("id").line(),
                    .title = map.required("title").line(),
                    .edition = map.required("edition").line(),
                    .transcription = map.required("transcription").choice({"partial", "complete"}),
                    .scale = read_scale(map.required("scale")),
                    .source = *source,
                    .responsivity = *responsivity};
  if (const auto notes = map.optional("notes")) {
    standard.notes = notes->text();
  }
  for (const YamlNode& item : map.required("geometries").list()) {
    standard.geometries.push_back(read_geometry(item, library));
  }
  if (const auto selection = map.optional("selection")) {
    standard.selection = read_selection(*selection);
  }
  if (const auto haze = map.optional("haze")) {
    for (const YamlNode& item : haze->list()) {
      standard.haze.push_back(read_haze(item));
    }
  }
  if (const auto flop = map.optional("flop")) {
    standard.flop = read_flop_rule(*flop);
  }
  if (const auto readings = map.optional("readings")) {
    standard.readings = read_reading_rule(*readings);
  }
  if (const auto rounding = map.optional("rounding")) {
    standard.rounding = rounding->read_map([&](YamlMap& rule) {
      return Stated<double>{.nominal = rule.required("step").gloss_gu(Range::positive()),
                            .evidence = read_evidence(rule.required("evidence")),
                            .mark = rounding->mark()};
    });
  }
  expect_geometries(standard, map.node());
  return standard;
}

Standard load_from(const fs::path& path, Library library) {
  library.being_read.push_back(path);
  return YamlNode::load(path).read_map(
      [&](YamlMap& map) { return read_standard(map, path, library); });
}

}  // namespace

bool ApertureLimits::is_known() const {
  return std::ranges::all_of(
      std::array{&in_plane, &perpendicular, &diameter},
      [](const std::optional<ApertureSize>* size) { return !*size || (*size)->value; });
}

const Stated<Angle>& ApertureSize::known() const {
  if (!value) {
    throw InputError(mark, "a number, to measure in this geometry", "unknown");
  }
  return *value;
}

Evidence GeometryLimits::evidence() const {
  Evidence weakest =
      theta_r ? Evidence::weaker(theta_i.evidence, theta_r->evidence) : theta_i.evidence;
  for (const ApertureLimits* aperture : {&source, &receptor}) {
    for (const auto* size : {&aperture->in_plane, &aperture->perpendicular, &aperture->diameter}) {
      if (*size && (*size)->value) {
        weakest = Evidence::weaker(weakest, (*size)->value->evidence);
      }
    }
  }
  return weakest;
}

const GeometryLimits& Standard::geometry(const std::string& geometry_id) const {
  for (const GeometryLimits& geometry : geometries) {
    if (geometry.id == geometry_id) {
      return geometry;
    }
  }
  throw std::out_of_range("Standard::geometry: " + id + " has no geometry " + geometry_id);
}

std::optional<std::string> Standard::select_geometry(
    const std::map<std::string, double>& value) const {
  if (!selection || !value.contains(selection->first)) {
    return std::nullopt;
  }
  const double first = value.at(selection->first);
  for (const SelectionRule& rule : selection->rules) {
    if ((rule.when_above && first > *rule.when_above) ||
        (rule.when_below && first < *rule.when_below)) {
      return rule.geometry;
    }
  }
  return selection->first;
}

Standard load_standard(const fs::path& path, const Catalog& catalog) {
  return load_from(path, {.catalog = catalog});
}

}  // namespace gonio

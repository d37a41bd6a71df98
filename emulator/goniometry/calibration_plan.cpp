#include "emulator/goniometry/calibration_plan.hpp"

#include <algorithm>
#include <cmath>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

constexpr int most_patches = 3 * 4096 * 4096;
constexpr double most_values = 1000.0;

/// `[3.7 deg, 4.7 deg]`, or `{from: 3.7 deg, to: 5.7 deg, step: 0.5 deg}`.
std::vector<Angle> read_axis(const YamlNode& node, const Range& range) {
  std::vector<Angle> values;
  if (node.is_list()) {
    for (const YamlNode& item : node.list()) {
      values.push_back(item.angle(range));
    }
    return values;
  }
  return node.read_map([&](YamlMap& map) {
    const double from = map.required("from").angle(range).degrees();
    const double to = map.required("to").angle(range).degrees();
    const double step = map.required("step").angle(Range::positive()).degrees();
    const double steps = std::round((to - from) / step);
    if (!(to >= from) || steps > most_values || std::abs(from + steps * step - to) > 1e-9) {
      node.fail("`to` a whole number of steps above `from`, 1000 at most");
    }
    for (int i = 0; i <= int(steps); ++i) {
      values.push_back(degrees(from + double(i) * step));
    }
    return values;
  });
}

int read_patches(const YamlNode& node) {
  const int patches = node.integer(48, most_patches);
  if (!patch_resolution(patches)) {
    node.fail("a number of patches 3 N^2, N a multiple of 4, e.g. 196608");
  }
  return patches;
}

GridAxes read_grid(const YamlNode& node) {
  const Range size = Range::closed(0.01, 60.0);
  return node.read_map([&](YamlMap& map) {
    GridAxes axes{.angle_offsets = {degrees(0.0)}};
    if (const auto offsets = map.optional("angle_offset")) {
      axes.angle_offsets = read_axis(*offsets, Range::closed(-45.0, 45.0));
    }
    axes.sources = read_axis(map.required("source"), size);
    axes.receptors = read_axis(map.required("receptor"), size);
    if (const auto patches = map.optional("patches")) {
      for (const YamlNode& item : patches->list()) {
        axes.patches.push_back(read_patches(item));
      }
    }
    return axes;
  });
}

std::optional<int> read_integrator(const YamlNode& node) {
  if (!node.is_map()) {
    (void)node.choice({"aperture"});
    return std::nullopt;
  }
  return node.read_map(
      [&](YamlMap& map) -> std::optional<int> { return read_patches(map.required("patches")); });
}

}  // namespace

CalibrationPlan load_calibration_plan(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/calibration/1");
    CalibrationPlan plan{.id = map.required("id").id(), .title = map.required("title").line()};
    if (const auto notes = map.optional("notes")) {
      (void)notes->text();
    }
    plan.instrument = catalog.find(Catalog::Kind::instrument, map.required("instrument"));
    plan.sample = catalog.find(Catalog::Kind::sample, map.required("sample"));
    if (const auto geometries = map.optional("geometries")) {
      for (const YamlNode& item : geometries->list()) {
        plan.geometries.push_back(item.id());
      }
    }
    if (const auto reference = map.optional("relative_to")) {
      plan.reference = reference->choice({"source", "receptor"}) == "source"
                           ? MirrorReference::source
                           : MirrorReference::receptor;
    }
    if (const auto integrator = map.optional("integrator")) {
      plan.patches = read_integrator(*integrator);
    }
    if (const auto grid = map.optional("grid")) {
      plan.grid = read_grid(*grid);
    }
    if (const auto free = map.optional("free")) {
      for (const YamlNode& item : free->list()) {
        plan.free.push_back(item.line());
      }
    }
    return plan;
  });
}

std::filesystem::path find_calibration_plan(const std::string& id_or_path, const Catalog& catalog) {
  const std::filesystem::path path(id_or_path);
  if (std::filesystem::exists(path) || path.has_parent_path() || path.has_extension()) {
    return path;
  }
  return catalog.fixture(std::filesystem::path("calibrations") / (id_or_path + ".yaml"));
}

GridAxes usual_grid(const Instrument& instrument, const std::string& geometry) {
  const MeasuringGeometry built = instrument.geometry(geometry);
  const auto axis = [](const Aperture& aperture) {
    const double size = std::round(20.0 * aperture.radius().degrees()) / 10.0;
    std::vector<Angle> values;
    for (const double off : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      if (size + off > 0.0) {
        values.push_back(degrees(size + off));
      }
    }
    return values;
  };
  return {.angle_offsets = {degrees(-0.5), degrees(0.0), degrees(0.5)},
          .sources = axis(built.source),
          .receptors = axis(built.receptor),
          .patches = {768, 3072, 12288, 49152, 196608}};
}

}  // namespace gonio

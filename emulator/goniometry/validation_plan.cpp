#include "emulator/goniometry/validation_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

constexpr int coarsest = 4, finest = 2048;

int read_resolution(const YamlNode& node) {
  const int resolution = node.integer(coarsest, finest);
  if (resolution % 4 != 0) {
    node.fail("a multiple of 4");
  }
  return resolution;
}

std::vector<int> read_convergence(const YamlNode& node) {
  std::vector<int> resolutions;
  for (const YamlNode& item : node.list()) {
    resolutions.push_back(read_resolution(item));
    if (resolutions.size() > 1 && resolutions.rbegin()[1] >= resolutions.back()) {
      item.fail(fmt::format("a resolution above the {} before it", resolutions.rbegin()[1]));
    }
  }
  return resolutions;
}

std::map<std::string, double> read_printed(const YamlNode& node, const Instrument& instrument) {
  std::map<std::string, double> printed;
  node.for_each_entry([&](const std::string& geometry, const YamlNode& value) {
    if (!instrument.has(geometry)) {
      value.fail(fmt::format("a geometry of {}", instrument.id), geometry);
    }
    printed[geometry] = value.number(Range::not_negative());
  });
  return printed;
}

ValidationMaterial read_material(const YamlNode& node, const Instrument& instrument) {
  return node.read_map([&](YamlMap& map) {
    ValidationMaterial material{
        .id = map.required("id").id(),
        .title = map.required("title").line(),
        .rms_slope = map.required("rms_slope").number({.low = 0.0, .high = 1.0, .low_open = true})};
    if (const auto printed = map.optional("printed_percent")) {
      material.printed_percent = read_printed(*printed, instrument);
    }
    for (const YamlNode& item : map.required("refractive_indices").list()) {
      material.indices.push_back(item.read_map([](YamlMap& index) {
        return NamedIndex{.author = index.required("author").line(),
                          .index = RefractiveIndex::read(index.required("index"))};
      }));
    }
    return material;
  });
}

}  // namespace

ValidationPlan load_validation_plan(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/validation/1");
    ValidationPlan plan{
        .file = path,
        .id = map.required("id").id(),
        .title = map.required("title").line(),
        .source = map.required("source").line(),
        .instrument = load_instrument(
            catalog.find(Catalog::Kind::instrument, map.required("instrument")), catalog),
        .patches = read_resolution(map.required("patches")),
        .convergence = read_convergence(map.required("convergence"))};
    for (const YamlNode& item : map.required("materials").list()) {
      plan.materials.push_back(read_material(item, plan.instrument));
      if (std::ranges::count(plan.materials, plan.materials.back().id, &ValidationMaterial::id) >
          1) {
        item.fail("each material once", plan.materials.back().id + " a second time");
      }
    }
    if (const auto limits = map.optional("limits")) {
      for (const YamlNode& item : limits->list()) {
        plan.limits.push_back(item.line());
      }
    }
    return plan;
  });
}

}  // namespace gonio

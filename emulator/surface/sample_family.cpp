#include "emulator/surface/sample_family.hpp"

#include <algorithm>

#include "emulator/core/yaml_map.hpp"
#include "emulator/surface/panel_reader.hpp"

namespace gonio {

SampleFamily::SampleFamily(Sample without_surface, PanelStatement statement)
    : plain_(std::move(without_surface)),
      coatings_(std::move(statement.coatings)),
      layout_(std::move(statement.layout)),
      whole_(layout_ ? shares(*layout_) : std::vector{SpotShare{.weight = 1.0}}) {}

SampleFamily SampleFamily::load(const std::filesystem::path& path, const WavelengthGrid& grid) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/sample/1");
    Sample sample{.file = path, .surface = {.grid = grid}};
    sample.id = map.required("id").id();
    sample.title = map.required("title").line();
    if (const auto notes = map.optional("notes")) {
      sample.notes = notes->text();
    }
    if (const auto tilt = map.optional("tilt")) {
      sample.tilt = tilt->angle(Range::closed(-45.0, 45.0));
    }
    return SampleFamily(std::move(sample), read_panel_statement(map, grid));
  });
}

Sample SampleFamily::sample(const SampleDeviation& deviation) const {
  Sample sample = plain_;
  const PanelSurface panel{.layout = layout_, .coatings = coatings_, .deviation = deviation};
  sample.surface = panel.mixed(whole_);
  if (layout_) {
    sample.panel = panel;
  }
  return sample;
}

Surface SampleFamily::surface(std::size_t region, const SampleDeviation& deviation) const {
  return coatings_.at(region).surface(deviation);
}

bool SampleFamily::has(SampleParameter parameter) const {
  return std::ranges::any_of(
      coatings_, [parameter](const Coating& coating) { return coating.has(parameter); });
}

}  // namespace gonio

#include "emulator/surface/panel_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gonio {

namespace {

constexpr std::size_t most_regions = 100;

double millimetres(const YamlNode& node, const Range& range) {
  constexpr double per_nanometre = 1e-6;
  return node.length(range).nanometres() * per_nanometre;
}

Outline read_outline(const YamlNode& node, Outline::Kind kind, const PanelLayout& layout) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode centre = map.required("centre");
    const std::vector<YamlNode> place = centre.list();
    if (place.size() != 2) {
      centre.fail("a list of two lengths, x and y", fmt::format("{}", place.size()));
    }
    const Outline outline{
        .kind = kind,
        .x_mm = millimetres(place[0], Range::any()),
        .y_mm = millimetres(place[1], Range::any()),
        .half_length_mm = 0.5 * millimetres(map.required("length"), Range::positive()),
        .half_width_mm = 0.5 * millimetres(map.required("width"), Range::positive())};
    if (std::abs(outline.x_mm - 0.5 * layout.length_mm) >=
            outline.half_length_mm + 0.5 * layout.length_mm ||
        std::abs(outline.y_mm - 0.5 * layout.width_mm) >=
            outline.half_width_mm + 0.5 * layout.width_mm) {
      centre.fail(fmt::format("a region on the panel of {:g} mm x {:g} mm", layout.length_mm,
                              layout.width_mm),
                  fmt::format("{:g} mm, {:g} mm", outline.x_mm, outline.y_mm));
    }
    return outline;
  });
}

/// `rectangle:` or `ellipse:`.
std::optional<Outline> read_shape(YamlMap& map, const PanelLayout& layout) {
  const auto rectangle = map.optional("rectangle");
  const auto ellipse = map.optional("ellipse");
  if (rectangle && ellipse) {
    ellipse->fail("either rectangle or ellipse", "both");
  }
  if (rectangle) {
    return read_outline(*rectangle, Outline::Kind::rectangle, layout);
  }
  return ellipse ? std::optional(read_outline(*ellipse, Outline::Kind::ellipse, layout))
                 : std::nullopt;
}

void expect_place(const YamlNode& node, const PanelLayout::Region& region, std::size_t number) {
  if (number == 0 && region.outline) {
    node.fail("a first region without a shape, which covers the panel", "a shape");
  }
  if (number > 0 && !region.outline) {
    node.fail("the key 'rectangle' or 'ellipse': only the first region covers the panel", "none");
  }
}

/// Adds the regions to the layout. @return  their coatings.
std::vector<Coating> read_regions(const YamlNode& list, const WavelengthGrid& grid,
                                  PanelLayout& layout) {
  std::vector<Coating> coatings;
  const std::vector<YamlNode> items = list.list();
  if (items.size() > most_regions) {
    list.fail(fmt::format("at most {} regions", most_regions), fmt::format("{}", items.size()));
  }
  for (const YamlNode& item : items) {
    coatings.push_back(item.read_map([&](YamlMap& map) {
      const YamlNode id = map.required("id");
      PanelLayout::Region region{.id = id.id(), .outline = read_shape(map, layout)};
      if (std::ranges::any_of(layout.regions,
                              [&](const auto& other) { return other.id == region.id; })) {
        id.fail("an id that no other region has");
      }
      expect_place(item, region, layout.regions.size());
      layout.regions.push_back(std::move(region));
      return read_coating(map, grid);
    }));
  }
  return coatings;
}

/// The models have to bear the extremes of a map.
void expect_in_range(const YamlNode& node, const std::vector<Coating>& coatings,
                     SampleParameter parameter, const ParameterMap& map) {
  for (const Coating& coating : coatings) {
    for (const double value : {map.lowest(), map.highest()}) {
      SampleDeviation deviation;
      deviation[parameter] = value;
      try {
        (void)coating.surface(deviation);
      } catch (const std::domain_error& error) {
        node.fail("values that keep each model within its range", error.what());
      }
    }
  }
}

void read_maps(const YamlNode& node, const std::vector<Coating>& coatings, PanelLayout& layout) {
  const auto read_all = [&](YamlMap& maps) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      const auto map = maps.optional(sample_parameter_names[p]);
      if (!map) {
        continue;
      }
      if (std::ranges::none_of(coatings,
                               [p](const auto& c) { return c.has(SampleParameter(p)); })) {
        map->fail("a map of a parameter that the sample has", sample_parameter_names[p]);
      }
      layout.maps[p].emplace(read_map_values(*map), layout.length_mm, layout.width_mm);
      expect_in_range(*map, coatings, SampleParameter(p), *layout.maps[p]);
      ++count;
    }
    return count;
  };
  if (node.read_map(read_all) == 0) {
    node.fail("a map at least", "none");
  }
}

}  // namespace

PanelStatement read_panel_statement(YamlMap& map, const WavelengthGrid& grid) {
  const auto panel = map.optional("panel");
  const auto regions = map.optional("regions");
  const auto maps = map.optional("maps");
  PanelLayout layout;
  if (panel) {
    panel->read_map([&](YamlMap& size) {
      layout.length_mm = millimetres(size.required("length"), Range::positive());
      layout.width_mm = millimetres(size.required("width"), Range::positive());
      return true;
    });
  } else if (regions || maps) {
    (void)map.required("panel");
  }
  if (!regions) {
    PanelStatement statement{.coatings = {read_coating(map, grid)}};
    if (panel) {
      layout.regions.push_back({.id = "panel"});
      if (maps) {
        read_maps(*maps, statement.coatings, layout);
      }
      statement.layout = std::make_shared<const PanelLayout>(std::move(layout));
    }
    return statement;
  }
  for (const char* other : {"surface", "lobes"}) {
    if (const auto node = map.optional(other)) {
      node->fail(fmt::format("either {} or regions", other), "both");
    }
  }
  PanelStatement statement{.coatings = read_regions(*regions, grid, layout)};
  if (maps) {
    read_maps(*maps, statement.coatings, layout);
  }
  statement.layout = std::make_shared<const PanelLayout>(std::move(layout));
  return statement;
}

}  // namespace gonio

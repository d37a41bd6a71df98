#include "emulator/instrument/uncertainty_statement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emulator/standard/setup_quantity.hpp"

namespace gonio {

namespace {

using Shape = Distribution::Shape;

constexpr double usual_coverage_factor = 2.0;
const std::vector<std::string> forms{"standard_uncertainty", "expanded_uncertainty", "half_width"};

/// Not negative, in the unit of the component.
double read_amount(const YamlNode& node, UncertaintyComponent component) {
  const std::string unit = uncertainty_component_units[std::size_t(component)];
  if (unit == "GU") {
    return node.gloss_gu(Range::not_negative());
  }
  return unit == "K" ? node.temperature_difference_k(Range::not_negative())
                     : node.number(Range::not_negative());
}

Shape read_bounded_shape(YamlMap& map) {
  const auto name = map.optional("distribution");
  if (!name) {
    return Shape::rectangular;
  }
  const std::string shape = name->choice({"rectangular", "triangular", "arcsine"});
  return shape == "rectangular"  ? Shape::rectangular
         : shape == "triangular" ? Shape::triangular
                                 : Shape::arcsine;
}

/// What may stand beside a standard or an expanded uncertainty.
Distribution read_normal(YamlMap& map, double standard_uncertainty) {
  Distribution distribution{.standard_uncertainty = standard_uncertainty};
  if (const auto name = map.optional("distribution")) {
    (void)name->choice({"normal"});
  }
  if (const auto degrees = map.optional("degrees_of_freedom")) {
    distribution.degrees_of_freedom = degrees->number(Range::positive());
  }
  return distribution;
}

void expect_one_form(YamlMap& map) {
  std::vector<std::string> stated;
  std::copy_if(forms.begin(), forms.end(), std::back_inserter(stated),
               [&](const std::string& form) { return map.has(form); });
  if (stated.size() != 1) {
    map.node().fail(fmt::format("one of the keys {}", fmt::join(forms, ", ")),
                    stated.empty() ? "none" : fmt::format("{}", fmt::join(stated, ", ")));
  }
}

Distribution read_distribution(const YamlNode& node, UncertaintyComponent component) {
  return node.read_map([&](YamlMap& map) {
    expect_one_form(map);
    if (const auto half_width = map.optional("half_width")) {
      return Distribution::bounded(read_bounded_shape(map), read_amount(*half_width, component));
    }
    if (const auto standard = map.optional("standard_uncertainty")) {
      return read_normal(map, read_amount(*standard, component));
    }
    const double expanded = read_amount(map.required("expanded_uncertainty"), component);
    const auto k = map.optional("coverage_factor");
    return read_normal(map, expanded / (k ? k->number(Range::positive()) : usual_coverage_factor));
  });
}

void expect_geometry(const std::vector<std::string>& geometry_ids, const std::string& id,
                     const YamlNode& node) {
  if (std::find(geometry_ids.begin(), geometry_ids.end(), id) == geometry_ids.end()) {
    node.fail(fmt::format("one of the geometries {}", fmt::join(geometry_ids, ", ")), id);
  }
}

/// The values of a map by geometry are maps; those of an uncertainty are not.
bool is_by_geometry(const YamlNode& node) {
  bool has_maps = false;
  node.for_each_entry(
      [&](const std::string&, const YamlNode& value) { has_maps = has_maps || value.is_map(); });
  return has_maps;
}

/// One uncertainty for all geometries, or one by geometry.
void read_component(const YamlNode& node, UncertaintyComponent component,
                    const std::vector<std::string>& geometry_ids,
                    std::map<std::string, Distribution>& by_geometry) {
  if (!is_by_geometry(node)) {
    const Distribution of_all = read_distribution(node, component);
    for (const std::string& id : geometry_ids) {
      by_geometry[id] = of_all;
    }
    return;
  }
  if (component == UncertaintyComponent::reference_index) {
    node.fail("one uncertainty, since all geometries stand on one glass", "one by geometry");
  }
  node.for_each_entry([&](const std::string& id, const YamlNode& value) {
    expect_geometry(geometry_ids, id, value);
    by_geometry[id] = read_distribution(value, component);
  });
}

std::vector<std::string> known_quantities() {
  std::vector<std::string> names(setup_quantity_names.begin(), setup_quantity_names.end());
  names.insert(names.end(), uncertainty_component_names.begin(), uncertainty_component_names.end());
  return names;
}

StatedCorrelation read_correlation(const YamlNode& node,
                                   const std::vector<std::string>& geometry_ids) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode between = map.required("between");
    const std::vector<YamlNode> pair = between.list();
    if (pair.size() != 2) {
      between.fail("a list of two quantities", fmt::format("{}", pair.size()));
    }
    const std::vector<std::string> known = known_quantities();
    StatedCorrelation correlation{
        .a = pair[0].choice(known),
        .b = pair[1].choice(known),
        .geometry = {},
        .coefficient = map.required("coefficient").number(Range::closed(-1.0, 1.0)),
        .mark = node.mark()};
    if (correlation.a == correlation.b) {
      pair[1].fail("another quantity than the first");
    }
    if (const auto geometry = map.optional("geometry")) {
      correlation.geometry = geometry->choice(geometry_ids);
    }
    return correlation;
  });
}

}  // namespace

UncertaintyStatement read_uncertainty(const YamlNode& node,
                                      const std::vector<std::string>& geometry_ids,
                                      UncertaintyStatement statement) {
  return node.read_map([&](YamlMap& map) {
    statement.mark = node.mark();
    for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
      if (const auto stated = map.optional(uncertainty_component_names[i])) {
        const auto component = UncertaintyComponent(i);
        read_component(*stated, component, geometry_ids, statement.components[component]);
      }
    }
    if (const auto correlations = map.optional("correlations")) {
      statement.correlations_mark = correlations->mark();
      statement.correlations.clear();
      for (const YamlNode& item : correlations->list()) {
        statement.correlations.push_back(read_correlation(item, geometry_ids));
      }
    }
    return std::move(statement);
  });
}

}  // namespace gonio

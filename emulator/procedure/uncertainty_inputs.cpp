#include "emulator/procedure/uncertainty_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "emulator/core/unit_value.hpp"

namespace gonio {

namespace {

using Shape = Distribution::Shape;

const char* name_of(UncertaintyComponent component) {
  return uncertainty_component_names[std::size_t(component)];
}
const char* name_of(SetupQuantity quantity) { return setup_quantity_names[std::size_t(quantity)]; }

/// The place of a key that is not in the instrument's file.
/// @param beside  the place of what it would belong to, if that is there.
SourceMark missing_key(const Instrument& instrument, SourceMark beside, std::string key) {
  if (beside.file.empty()) {
    beside.file = instrument.file.empty() ? instrument.id : instrument.file.string();
  }
  beside.key = std::move(key);
  return beside;
}

/// As an instrument file calls it, e.g. source.in_plane.
std::string file_key(SetupQuantity quantity) {
  std::string name = name_of(quantity);
  for (const std::string opening : {"source_", "receptor_"}) {
    if (name.starts_with(opening)) {
      name[opening.size() - 1] = '.';
    }
  }
  return name;
}

InputQuantity setup_input(const Instrument& instrument, const std::string& id,
                          SetupQuantity quantity, Angle value) {
  const auto expanded = stated_uncertainty(instrument, id, quantity);
  if (!expanded) {
    const auto built = instrument.as_built.find(id);
    throw InputError(
        missing_key(instrument,
                    built == instrument.as_built.end() ? SourceMark{} : built->second.mark,
                    fmt::format("as_built.{}.{}", id, file_key(quantity))),
        "its expanded_uncertainty, or the key 'setup_uncertainty' for all", "nothing");
  }
  return {.id = fmt::format("{}/{}", id, name_of(quantity)),
          .estimate = stated_degrees(value),
          .distribution = {.standard_uncertainty = 0.5 * expanded->degrees()}};
}

/// What the instrument's file says of it elsewhere, if anything.
std::optional<Distribution> default_of(const Behaviour& behaviour, UncertaintyComponent component) {
  switch (component) {
    case UncertaintyComponent::repeatability:
      return Distribution{.standard_uncertainty = behaviour.repeatability_gu};
    case UncertaintyComponent::resolution:
      return Distribution::bounded(Shape::rectangular, 0.5 * behaviour.resolution_gu);
    default:
      return std::nullopt;
  }
}

Distribution component_distribution(const Instrument& instrument, const std::string& id,
                                    UncertaintyComponent component) {
  const UncertaintyStatement none;
  const UncertaintyStatement& statement = instrument.uncertainty ? *instrument.uncertainty : none;
  const auto stated = statement.components.find(component);
  const bool is_stated = stated != statement.components.end();
  if (is_stated && stated->second.contains(id)) {
    return stated->second.at(id);
  }
  if (const auto usual = default_of(instrument.behaviour, component)) {
    return *usual;
  }
  const std::string unit = uncertainty_component_units[std::size_t(component)];
  throw InputError(
      missing_key(instrument, statement.mark,
                  fmt::format("uncertainty.{}{}", name_of(component), is_stated ? "." + id : "")),
      fmt::format("an uncertainty{} for the geometry '{}'", unit.empty() ? "" : " in " + unit, id),
      "nothing");
}

double component_estimate(const Instrument& instrument, const std::string& id,
                          UncertaintyComponent component) {
  if (component == UncertaintyComponent::linearity) {
    return instrument.behaviour.linearity;
  }
  const auto found = instrument.polarization.find(id);
  return component == UncertaintyComponent::polarization && found != instrument.polarization.end()
             ? found->second
             : 0.0;
}

/// Adds the inputs of one geometry after each other.
GeometryInputs add_geometry(const Instrument& instrument, const std::string& id,
                            const std::vector<GeometryInputs>& before, InputSet& set) {
  GeometryInputs inputs{.geometry = id};
  std::vector<InputQuantity> components;
  for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
    const auto component = UncertaintyComponent(i);
    const bool is_common = component == UncertaintyComponent::reference_index;
    components.push_back(
        {.id = is_common ? name_of(component) : fmt::format("{}/{}", id, name_of(component)),
         .estimate = component_estimate(instrument, id, component),
         .distribution = component_distribution(instrument, id, component)});
  }
  for (std::size_t i = 0; i < setup_quantity_count; ++i) {
    const auto quantity = SetupQuantity(i);
    if (const auto built = as_built(instrument, id, quantity)) {
      inputs.setup.push_back(quantity);
      inputs.setup_index.push_back(set.add(setup_input(instrument, id, quantity, built->value)));
    }
  }
  for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
    const bool is_there =
        UncertaintyComponent(i) == UncertaintyComponent::reference_index && !before.empty();
    inputs.component_index[i] =
        is_there ? before.front().component_index[i] : set.add(std::move(components[i]));
  }
  return inputs;
}

/// Nothing if the geometry has no such quantity.
std::optional<std::size_t> index_of(const GeometryInputs& inputs, const std::string& name) {
  for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
    if (uncertainty_component_names[i] == name) {
      return inputs.component_index[i];
    }
  }
  for (std::size_t i = 0; i < inputs.setup.size(); ++i) {
    if (name_of(inputs.setup[i]) == name) {
      return inputs.setup_index[i];
    }
  }
  return std::nullopt;
}

/// A size of an opening may be there or not; all else is.
bool has(const Instrument& instrument, const std::string& id, const std::string& name) {
  const auto quantity = setup_quantity(name);
  return !quantity || as_built(instrument, id, *quantity);
}

/// Whatever geometries were asked for.
void expect_somewhere(const Instrument& instrument, const StatedCorrelation& stated) {
  const std::vector<std::string> ids =
      stated.geometry ? std::vector{*stated.geometry} : instrument.geometries;
  if (std::none_of(ids.begin(), ids.end(), [&](const std::string& id) {
        return instrument.has(id) && has(instrument, id, stated.a) && has(instrument, id, stated.b);
      })) {
    throw InputError(stated.mark,
                     stated.geometry
                         ? fmt::format("two quantities of the geometry '{}'", *stated.geometry)
                         : "two quantities of one geometry",
                     fmt::format("{}, {}", stated.a, stated.b));
  }
}

void expect_normal(const InputQuantity& input, const SourceMark& mark) {
  const Distribution& distribution = input.distribution;
  if (distribution.shape != Shape::normal || std::isfinite(distribution.degrees_of_freedom)) {
    throw InputError(mark, "normal quantities without degrees_of_freedom", input.id);
  }
}

void correlate(const Instrument& instrument, UncertaintyInputs& inputs) {
  for (const StatedCorrelation& stated : instrument.uncertainty->correlations) {
    expect_somewhere(instrument, stated);
    for (const GeometryInputs& geometry : inputs.geometries) {
      const auto a = index_of(geometry, stated.a);
      const auto b = index_of(geometry, stated.b);
      if (a && b && stated.geometry.value_or(geometry.geometry) == geometry.geometry) {
        expect_normal(inputs.set.inputs()[*a], stated.mark);
        expect_normal(inputs.set.inputs()[*b], stated.mark);
        inputs.set.correlate(*a, *b, stated.coefficient);
      }
    }
  }
  if (const double smallest = inputs.set.smallest_eigenvalue();
      !(smallest > InputSet::positive_definite)) {
    throw InputError(instrument.uncertainty->correlations_mark,
                     "correlations that can hold together (a positive definite matrix)",
                     fmt::format("the eigenvalue {:.3g}", smallest));
  }
}

}  // namespace

UncertaintyInputs uncertainty_inputs(const Instrument& instrument,
                                     const std::vector<std::string>& geometry_ids) {
  UncertaintyInputs inputs;
  for (const std::string& id : geometry_ids) {
    if (!instrument.has(id)) {
      throw std::invalid_argument(
          fmt::format("uncertainty_inputs: {} has no geometry '{}'", instrument.id, id));
    }
    inputs.geometries.push_back(add_geometry(instrument, id, inputs.geometries, inputs.set));
  }
  if (instrument.uncertainty) {
    correlate(instrument, inputs);
  }
  return inputs;
}

}  // namespace gonio

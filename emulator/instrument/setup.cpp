#include "emulator/instrument/setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gonio {

namespace {

bool is_of_source(SetupQuantity quantity) {
  return quantity == SetupQuantity::source_in_plane ||
         quantity == SetupQuantity::source_perpendicular ||
         quantity == SetupQuantity::source_diameter;
}

bool is_diameter(SetupQuantity quantity) {
  return quantity == SetupQuantity::source_diameter || quantity == SetupQuantity::receptor_diameter;
}

bool is_direction(SetupQuantity quantity) {
  return quantity == SetupQuantity::theta_i || quantity == SetupQuantity::theta_r;
}

/// The member of an opening, as built or by the standard, that holds that size.
template <class Opening>
auto& size_of(Opening& opening, SetupQuantity quantity) {
  switch (quantity) {
    case SetupQuantity::source_in_plane:
    case SetupQuantity::receptor_in_plane:
      return opening.in_plane;
    case SetupQuantity::source_perpendicular:
    case SetupQuantity::receptor_perpendicular:
      return opening.perpendicular;
    default:
      return opening.diameter;
  }
}

/// The source or the receptor of a geometry, as built or by the standard.
template <class Geometry>
auto& opening_of(Geometry& geometry, SetupQuantity quantity) {
  return is_of_source(quantity) ? geometry.source : geometry.receptor;
}

template <class Built>
auto& stated_in(Built& built, SetupQuantity quantity) {
  switch (quantity) {
    case SetupQuantity::theta_i:
      return built.theta_i;
    case SetupQuantity::theta_r:
      return built.theta_r;
    default:
      return size_of(opening_of(built, quantity), quantity);
  }
}

GeometryAsBuilt built_of(const Instrument& instrument, const std::string& geometry_id) {
  const auto found = instrument.as_built.find(geometry_id);
  return found == instrument.as_built.end() ? GeometryAsBuilt{} : found->second;
}

/// A size as built decides whether an opening is a circle; else the standard does.
bool has_quantity(const Instrument& instrument, const std::string& geometry_id,
                  SetupQuantity quantity) {
  if (!instrument.has(geometry_id)) {
    return false;
  }
  if (is_direction(quantity)) {
    return true;
  }
  const GeometryAsBuilt built = built_of(instrument, geometry_id);
  const OpeningAsBuilt& opening = opening_of(built, quantity);
  const bool has_sides = opening.in_plane || opening.perpendicular;
  const bool is_circle =
      opening.diameter ||
      (!has_sides && opening_of(instrument.standard.geometry(geometry_id), quantity).is_circle());
  return is_circle == is_diameter(quantity);
}

/// Nothing if it is unknown.
std::optional<Angle> nominal_of(const GeometryLimits& limits, SetupQuantity quantity) {
  if (quantity == SetupQuantity::theta_r) {
    return limits.receptor_angle();
  }
  const Stated<Angle>* limit = limit_of(limits, quantity);
  return limit == nullptr ? std::nullopt : std::optional(limit->nominal);
}

}  // namespace

std::optional<StatedAngle> as_built(const Instrument& instrument, const std::string& geometry_id,
                                    SetupQuantity quantity) {
  if (!has_quantity(instrument, geometry_id, quantity)) {
    return std::nullopt;
  }
  const GeometryAsBuilt built = built_of(instrument, geometry_id);
  if (const auto& found = stated_in(built, quantity)) {
    return StatedAngle{.value = found->value,
                       .expanded_uncertainty =
                           stated_uncertainty(instrument, geometry_id, quantity).value_or(Angle())};
  }
  const auto nominal = nominal_of(instrument.standard.geometry(geometry_id), quantity);
  return nominal ? std::optional(StatedAngle{.value = *nominal}) : std::nullopt;
}

std::optional<Angle> stated_uncertainty(const Instrument& instrument,
                                        const std::string& geometry_id, SetupQuantity quantity) {
  const GeometryAsBuilt built = built_of(instrument, geometry_id);
  const auto& found = stated_in(built, quantity);
  if (found && found->expanded_uncertainty) {
    return found->expanded_uncertainty;
  }
  const SetupUncertainty& usual = instrument.setup_uncertainty;
  return is_direction(quantity) ? usual.angles : usual.apertures;
}

Instrument with_quantity(Instrument instrument, const std::string& geometry_id,
                         SetupQuantity quantity, const StatedAngle& value) {
  if (!has_quantity(instrument, geometry_id, quantity)) {
    throw std::invalid_argument(
        fmt::format("with_quantity: {} has no {} in the geometry '{}'", instrument.id,
                    setup_quantity_names[std::size_t(quantity)], geometry_id));
  }
  const SourceMark& place = instrument.standard.geometry(geometry_id).mark;
  GeometryAsBuilt& built =
      instrument.as_built.try_emplace(geometry_id, GeometryAsBuilt{.mark = place}).first->second;
  stated_in(built, quantity) =
      AngleAsBuilt{.value = value.value, .expanded_uncertainty = value.expanded_uncertainty};
  return instrument;
}

Instrument by_standard(const Instrument& instrument, const Standard& standard) {
  if (standard.id == instrument.standard.id) {
    return instrument;
  }
  Instrument result = instrument;
  result.standard = standard;
  result.geometries.clear();
  result.behaviour.full_scale_gu.clear();
  for (std::size_t channel = 0; channel < instrument.geometries.size(); ++channel) {
    const std::string& id = instrument.geometries[channel];
    if (std::ranges::none_of(standard.geometries, [&](const auto& g) { return g.id == id; })) {
      continue;
    }
    result.geometries.push_back(id);
    if (!instrument.behaviour.full_scale_gu.empty()) {
      result.behaviour.full_scale_gu.push_back(instrument.behaviour.full_scale_gu[channel]);
    }
    const GeometryLimits& limits = instrument.standard.geometry(id);
    GeometryAsBuilt& built =
        result.as_built.try_emplace(id, GeometryAsBuilt{.mark = limits.mark}).first->second;
    for (std::size_t i = 0; i < setup_quantity_count; ++i) {
      const auto quantity = SetupQuantity(i);
      const auto nominal = nominal_of(limits, quantity);
      if (nominal && has_quantity(instrument, id, quantity) && !stated_in(built, quantity)) {
        stated_in(built, quantity) = AngleAsBuilt{.value = *nominal};
      }
    }
  }
  if (result.geometries.empty()) {
    throw std::invalid_argument(
        fmt::format("expected a standard with one of the "
                    "geometries {} of {}, found '{}'",
                    fmt::join(instrument.geometries, ", "), instrument.id, standard.id));
  }
  return result;
}

}  // namespace gonio

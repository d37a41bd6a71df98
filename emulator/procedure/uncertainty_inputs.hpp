#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/instrument/setup.hpp"
#include "emulator/instrument/uncertainty_statement.hpp"
#include "emulator/uncertainty/input_set.hpp"

namespace gonio {

/// Where the inputs of one geometry stand in an InputSet.
struct GeometryInputs {
  std::string geometry;
  std::vector<SetupQuantity> setup = {};      ///< those that the geometry has
  std::vector<std::size_t> setup_index = {};  ///< of the same
  std::array<std::size_t, uncertainty_component_count> component_index = {};
};

/// The input quantities of an instrument's readings. Angles in degrees, else the units of
/// `uncertainty_component_units`. Ids are `60/theta_i`, but `reference_index` alone: all geometries
/// stand on the same glass.
struct UncertaintyInputs {
  InputSet set = {};
  std::vector<GeometryInputs> geometries = {};  ///< as asked for
};

/// The set-up with its expanded uncertainty (k = 2, normal), all components as stated; where they
/// are not stated, `repeatability` as in the instrument's behaviour (normal) and `resolution` as
/// half a step of its display (rectangular).
/// @throws InputError  at the instrument's file where an uncertainty is not stated, where a
///                     correlation is not of normal quantities, and where the correlations are not
///                     positive definite.
/// @throws std::invalid_argument  for a geometry that the instrument has not.
[[nodiscard]] UncertaintyInputs uncertainty_inputs(const Instrument& instrument,
                                                   const std::vector<std::string>& geometry_ids);

}  // namespace gonio

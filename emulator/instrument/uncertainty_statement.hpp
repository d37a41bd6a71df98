#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/uncertainty/distribution.hpp"

namespace gonio {

/// What makes a reading uncertain besides the angles and openings of the set-up. The estimate of
/// each is 0, or what the instrument's file says of it (polarization, linearity).
enum class UncertaintyComponent {
  polarization,       ///< the P of `polarised`
  spectral_mismatch,  ///< slope of source times responsivity over wavelength, relative, per 100 nm
  reference_index,    ///< of the glass that carries the scale
  reference_value,    ///< of the working standard, in GU where it reads the value of the scale
  linearity,          ///< of Behaviour
  zero,               ///< what is left of stray light after the zero, in GU
  drift,              ///< of the signal since the calibration, relative
  temperature,        ///< change since the calibration, in K
  resolution,         ///< rounding of the display, in GU
  repeatability       ///< in GU
};
constexpr std::size_t uncertainty_component_count = 10;

/// As input files and people call them, in the order of UncertaintyComponent.
inline constexpr std::array<const char*, uncertainty_component_count> uncertainty_component_names{
    "polarization", "spectral_mismatch", "reference_index", "reference_value", "linearity", "zero",
    "drift",        "temperature",       "resolution",      "repeatability"};
/// Empty for a number.
inline constexpr std::array<const char*, uncertainty_component_count> uncertainty_component_units{
    "", "", "", "GU", "", "GU", "", "K", "GU", "GU"};

/// Two quantities of a geometry whose errors go together.
struct StatedCorrelation {
  std::string a, b;                     ///< of SetupQuantity or UncertaintyComponent, by name
  std::optional<std::string> geometry;  ///< nothing: of each that has both
  double coefficient = 0.0;
  SourceMark mark = {};
};

/// The map `uncertainty` of an instrument file.
///
///     uncertainty:
///       reference_index: {standard_uncertainty: 0.0005, degrees_of_freedom: 50}
///       reference_value: {expanded_uncertainty: 0.4 GU, coverage_factor: 2}
///       polarization: {half_width: 0.01}                # rectangular, or `distribution:`
///       spectral_mismatch: {"20": {half_width: 0.02}, "60": ..., "85": ...}
///       temperature: {half_width: 2 K, distribution: arcsine}
///       correlations: [{between: [theta_i, theta_r], coefficient: 0.5, geometry: "60"}]
struct UncertaintyStatement {
  SourceMark mark = {};
  /// By component and geometry; what is not stated is not there.
  std::map<UncertaintyComponent, std::map<std::string, Distribution>> components = {};
  std::vector<StatedCorrelation> correlations = {};  ///< of two for one pair the later one counts
  SourceMark correlations_mark = {};
};

/// Reads the map `uncertainty`. Of each component it states one of
///
///   standard_uncertainty, or expanded_uncertainty with coverage_factor (2 if not stated): normal,
///     `degrees_of_freedom` > 0 beside it or without end
///   half_width: rectangular, or as `distribution` says triangular or arcsine
///
/// for all geometries or by geometry; of reference_index for all.
/// @param geometry_ids  of the instrument.
/// @param statement     what is not stated stays as it is there; correlations that are stated
///                      replace the others.
/// @throws InputError  for anything that is not as above.
[[nodiscard]] UncertaintyStatement read_uncertainty(const YamlNode& node,
                                                    const std::vector<std::string>& geometry_ids,
                                                    UncertaintyStatement statement = {});

}  // namespace gonio

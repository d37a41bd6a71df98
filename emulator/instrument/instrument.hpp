#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/catalog.hpp"
#include "emulator/core/table.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/behaviour.hpp"
#include "emulator/instrument/uncertainty_statement.hpp"
#include "emulator/integration/aperture.hpp"
#include "emulator/standard/standard.hpp"
#include "emulator/surface/spot.hpp"

namespace gonio {

/// An angle as it was found.
struct AngleAsBuilt {
  Angle value;
  /// k = 2; nothing: as Instrument::setup_uncertainty says
  std::optional<Angle> expanded_uncertainty = {};
};

/// How well what was found is known where that is not stated one by one: k = 2. Nothing where that
/// is not stated either.
struct SetupUncertainty {
  std::optional<Angle> angles = {};     ///< of theta_i and theta_r
  std::optional<Angle> apertures = {};  ///< of the sizes of source and receptor

  bool operator==(const SetupUncertainty&) const = default;
};

/// The size of an aperture as built; nothing where it is as the standard says.
struct OpeningAsBuilt {
  std::optional<AngleAsBuilt> in_plane = {}, perpendicular = {};  ///< of a rectangle
  std::optional<AngleAsBuilt> diameter = {};                      ///< of a circle
  SourceMark mark = {};
};

/// One geometry as built; nothing where it is as the standard says.
struct GeometryAsBuilt {
  std::optional<AngleAsBuilt> theta_i = {}, theta_r = {};
  OpeningAsBuilt source = {}, receptor = {};
  SourceMark mark = {};
};

/// The beam that lights a sample, across its direction: what it lights is an ellipse.
struct BeamSection {
  double in_plane_mm = 0.0, perpendicular_mm = 0.0;  ///< full axes

  bool operator==(const BeamSection&) const = default;
};

/// An instrument: the standard it was built to, and how it deviates from it.
struct Instrument {
  std::filesystem::path file;  ///< empty for the nominal instrument of a standard
  std::string id;
  std::string title;
  std::string notes = {};
  Standard standard;
  std::vector<std::string> geometries = {};  ///< ids of those it has, in the standard's order
  std::map<std::string, GeometryAsBuilt> as_built = {};  ///< by id
  SetupUncertainty setup_uncertainty = {};
  /// By id: how much source and receptor together favour light polarised perpendicular to the plane
  /// of measurement, the P of `polarised`; 0 for a geometry that is not named.
  std::map<std::string, double> polarization = {};
  /// By id; a geometry that is not named measures at a point.
  std::map<std::string, BeamSection> beam = {};
  std::optional<UncertaintyStatement> uncertainty = {};
  SpectralTable source;  ///< spectral power distribution
  SpectralTable responsivity;
  Identity identity = {};
  Behaviour behaviour = {};
  std::vector<std::filesystem::path> samples = {};  ///< files of what lies beside it
  /// The map `wire`, unread: what it means is the protocol's business, and its errors are found
  /// there.
  std::optional<YamlNode> wire = {};

  [[nodiscard]] bool has(const std::string& geometry_id) const;
  /// The apertures of one geometry, in the frame of a sample that lies flat; of a sphere, its gloss
  /// trap.
  /// @throws InputError         if the standard leaves a size unknown that is not stated as built.
  /// @throws std::out_of_range  if the instrument has no such geometry.
  [[nodiscard]] MeasuringGeometry geometry(const std::string& geometry_id) const;
  /// Of one geometry, as built.
  /// @throws std::out_of_range  if the instrument has no such geometry.
  [[nodiscard]] Angle angle_of_incidence(const std::string& geometry_id) const;
  /// What one geometry measures of a flat sample that it stands on at a place [mm]: the beam,
  /// longer by 1 / cos theta_i in the plane of measurement.
  /// @throws std::out_of_range  if the instrument has no such geometry.
  [[nodiscard]] Spot spot(const std::string& geometry_id, double x_mm, double y_mm) const;
};

/// The instrument that has the nominal values of a standard.
[[nodiscard]] Instrument nominal_instrument(const Standard& standard);

/// @throws std::invalid_argument  if the instrument measures colour, not gloss.
void expect_gloss(const Instrument& instrument);

/// Reads a file of schema gonio/instrument/1.
/// @param catalog  where `built_to` and `samples` are looked up.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Instrument load_instrument(const std::filesystem::path& path, const Catalog& catalog);

}  // namespace gonio

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/catalog.hpp"
#include "emulator/core/input_error.hpp"
#include "emulator/core/length.hpp"
#include "emulator/core/table.hpp"
#include "emulator/standard/evidence.hpp"
#include "emulator/standard/flop_rule.hpp"
#include "emulator/standard/reading_rule.hpp"

namespace gonio {

/// One size of an aperture: full angle as seen from the sample, or where the file says `unknown`.
struct ApertureSize {
  std::optional<Stated<Angle>> value;
  SourceMark mark;

  /// @throws InputError  at the mark if the size is unknown.
  [[nodiscard]] const Stated<Angle>& known() const;
};

/// A rectangle (in_plane, perpendicular) or a circle (diameter); of a receptor, an integrating
/// sphere too.
struct ApertureLimits {
  std::optional<ApertureSize> in_plane, perpendicular, diameter;
  /// It collects the hemisphere, but for a gloss trap of that diameter round theta_r; without a
  /// diameter there is no trap, and the specular part is included.
  bool is_sphere = false;

  [[nodiscard]] bool is_circle() const { return diameter.has_value(); }
  /// The standard leaves none of its sizes unknown.
  [[nodiscard]] bool is_known() const;
};

/// One geometry of a standard.
struct GeometryLimits {
  std::string id;
  Stated<Angle> theta_i;
  std::optional<Stated<Angle>> theta_r;  ///< nothing: the mirror direction
  ApertureLimits source, receptor;
  std::optional<std::string> relative_to;  ///< id of the geometry where the reference is read
  SourceMark mark;

  [[nodiscard]] Angle receptor_angle() const {
    return theta_r ? theta_r->nominal : theta_i.nominal;
  }
  /// The weakest evidence of all its known numbers.
  [[nodiscard]] Evidence evidence() const;
};

/// What the numbers of a scale mean.
struct Scale {
  enum class Reference { glass, incident_flux, perfect_diffuser };
  std::string unit;  ///< e.g. GU
  Reference reference = Reference::glass;
  Stated<double> value;                                         ///< what the reference reads
  std::optional<Stated<double>> refractive_index = {};          ///< of the reference glass
  std::optional<Stated<Wavelength>> reference_wavelength = {};  ///< at which it has that index

  /// Relative to the perfect reflecting diffuser is how colour is measured; all others are gloss.
  [[nodiscard]] bool is_of_colour() const { return reference == Reference::perfect_diffuser; }
};

/// Another geometry is to be used where the value at the first one lies beyond a limit.
struct SelectionRule {
  std::string geometry;
  std::optional<double> when_above, when_below;  ///< strictly; in the unit of the scale
  Evidence evidence;
};

struct Selection {
  std::string first;
  std::vector<SelectionRule> rules;
};

/// Haze as the difference of two gloss values.
struct HazeRule {
  std::string id;
  std::string from, minus;           ///< geometries
  std::optional<double> only_above;  ///< defined only where the value at `from` is above that
  Evidence evidence;
};

/// A standard, from standards/<family>/<edition>/standard.yaml.
struct Standard {
  std::filesystem::path file;
  std::string id;
  std::string title;
  std::string edition;
  std::string transcription;
  std::string notes = {};
  Scale scale;
  SpectralTable source;  ///< spectral power distribution
  SpectralTable responsivity;
  std::vector<GeometryLimits> geometries = {};
  std::optional<Selection> selection = {};
  std::vector<HazeRule> haze = {};
  std::optional<FlopRule> flop = {};
  std::optional<ReadingRule> readings = {};
  std::optional<Stated<double>> rounding = {};  ///< step to which a value is reported

  /// @throws std::out_of_range  if there is no such geometry.
  [[nodiscard]] const GeometryLimits& geometry(const std::string& geometry_id) const;

  /// The geometry to report, for values by geometry; nothing if the standard does not say, or if
  /// the value at its first geometry is missing.
  [[nodiscard]] std::optional<std::string> select_geometry(
      const std::map<std::string, double>& value) const;
};

/// Reads a file of schema gonio/standard/1.
/// @param catalog  where the standards of `same_as` are looked up that do not stand beside this
/// one,
///                 as <family>/<edition>.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Standard load_standard(const std::filesystem::path& path,
                                     const Catalog& catalog = Catalog());

}  // namespace gonio

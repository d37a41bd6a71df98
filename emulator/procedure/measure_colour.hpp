#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/instrument/colorimeter.hpp"
#include "emulator/optics/colorimetry.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// For which light and which eye a colour is computed.
struct ColourConditions {
  std::string illuminant = "d65";  ///< of fixtures/illuminants
  std::string observer = "10";     ///< field of view in degrees, 2 (of 1931) or 10 (of 1964)
  Eigen::ArrayXd power = {};       ///< of the illuminant, shape (n_lambda)
  Observer matching = {};

  /// Illuminant times y_bar, of sum 1, shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd luminous_weight() const;
};

/// The names that load_colour_conditions() knows.
[[nodiscard]] const std::vector<std::string>& colour_illuminants();
[[nodiscard]] const std::vector<std::string>& colour_observers();

/// @throws InputError  if the tables do not cover the grid.
[[nodiscard]] ColourConditions load_colour_conditions(const Catalog& catalog,
                                                      const std::string& illuminant,
                                                      const std::string& observer,
                                                      const WavelengthGrid& grid);

/// How a colour is measured.
struct ColourOptions {
  std::vector<std::string> geometries = {};  ///< ids, each measured once; empty for all there are
  double tolerance = 1e-6;                   ///< of the integrator, of the luminous radiance factor
  Angle tilt = {};                           ///< added to the sample's
};

struct ColourGeometryResult {
  std::string id;
  Angle theta_i;                   ///< nominal
  std::optional<Angle> theta_r;    ///< nominal; nothing for a sphere
  std::optional<Angle> aspecular;  ///< positive towards the normal
  ColourReading reading;
  Xyz xyz;
  std::optional<Chromaticity> xy;  ///< nothing of black
  Lab lab;
  Evidence evidence;  ///< weakest of the standard's numbers that the geometry rests on
};

struct FlopResult {
  std::optional<double> value;  ///< nothing where a geometry was not measured, or see flop_index()
  Evidence evidence;
};

/// The colour of a sample in each geometry. A panel that is not the same everywhere is measured as
/// its mean.
struct ColourMeasurement {
  std::string sample;
  std::string sample_title;
  std::vector<ColourGeometryResult> geometries = {};
  std::optional<FlopResult> flop = {};  ///< nothing if the standard has no such rule
};

/// The flop index by the rule of a standard, 0 for what is as light from all sides.
/// @param lightness  L* by geometry.
/// @return  nothing if a geometry is missing, the face is black, or the sample is lighter far from
///          the mirror direction than near it, of which the formula says nothing.
[[nodiscard]] std::optional<double> flop_index(const FlopRule& rule,
                                               const std::map<std::string, double>& lightness);

/// @throws InputError             for an aperture of unknown size.
/// @throws std::invalid_argument  for a geometry that the instrument does not have.
[[nodiscard]] ColourMeasurement measure_colour(const Sample& sample, const Colorimeter& colorimeter,
                                               const ColourConditions& conditions,
                                               const ColourOptions& options = {});

/// Measures many samples, on all cores; results in the order of the samples.
/// @param advance  called once after each sample, from any thread, one at a time.
[[nodiscard]] std::vector<ColourMeasurement> measure_colours(
    const std::vector<Sample>& samples, const Colorimeter& colorimeter,
    const ColourConditions& conditions, const ColourOptions& options,
    const std::function<void()>& advance = {});

}  // namespace gonio

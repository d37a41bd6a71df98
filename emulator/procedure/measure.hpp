#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/optics/colorimetry.hpp"
#include "emulator/procedure/evaluation.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// Where an instrument stands on a panel: the middle of what it measures, from the origin of the
/// panel.
struct PanelPosition {
  double x_mm = 0.0;  ///< along the plane of measurement
  double y_mm = 0.0;  ///< across it

  bool operator==(const PanelPosition&) const = default;
};

/// How a measurement is done.
struct MeasureOptions {
  std::vector<std::string> geometries = {};  ///< ids, each measured once; empty for all it has
  double tolerance = 1e-4;                   ///< of the integrator, in the unit of the scale
  Angle tilt = {};                           ///< in the plane of measurement, added to the sample's
  /// Nothing: the centre of a panel. Of no meaning for a sample without one.
  std::optional<PanelPosition> position = {};
};

/// The colour of the reflected light under the instrument's source, for the 2 deg observer of 1931;
/// white is what a perfect mirror reflects.
struct ReflectedColour {
  Xyz xyz;
  Chromaticity xy;
  Lab lab;
};

/// What was measured of a panel.
struct SpotOnPanel {
  struct RegionShare {
    std::string id;
    double share = 0.0;  ///< of the spot
  };
  Spot spot;
  std::vector<RegionShare> regions = {};  ///< those that it covers; empty if there is but one
};

struct GeometryResult {
  std::string id;
  Angle theta_i;  ///< nominal
  GlossReading reading;
  std::optional<ReflectedColour> colour;  ///< nothing where no light arrives
  Evidence evidence;                      ///< weakest of the numbers that the geometry rests on
  std::optional<SpotOnPanel> spot = {};   ///< of a sample with a panel
};

/// A sample measured by the procedure of a standard.
struct Measurement {
  std::string sample;
  std::string sample_title;
  std::vector<GeometryResult> geometries = {};
  std::optional<std::string> selected_geometry = {};
  std::vector<HazeResult> haze = {};
  std::optional<PanelPosition> position = {};  ///< of a sample with a panel
  std::vector<std::string> warnings = {};      ///< of measured BRDFs, see measured_warnings.hpp

  /// @return  the result of a geometry, or null.
  [[nodiscard]] const GeometryResult* find(const std::string& geometry_id) const;
};

/// The geometries asked for, each once; all that the instrument has if none is.
/// @throws std::invalid_argument  for one that the instrument does not have.
[[nodiscard]] std::vector<std::string> geometries_asked_for(const Instrument& instrument,
                                                            const std::vector<std::string>& ids);

/// Measures a sample in the geometries asked for; of a panel, what each of their spots covers.
/// @throws InputError             for an aperture of unknown size.
/// @throws std::invalid_argument  for a geometry that the instrument does not have, a position on a
///                                sample that is no panel, or a spot that hangs over its edge.
[[nodiscard]] Measurement measure(const Sample& sample, const Glossmeter& glossmeter,
                                  const Observer& observer, const MeasureOptions& options);

/// Measures many samples, on all cores; results in the order of the samples.
/// @param advance  called once after each sample, from any thread, one at a time.
[[nodiscard]] std::vector<Measurement> measure_all(const std::vector<Sample>& samples,
                                                   const Glossmeter& glossmeter,
                                                   const Observer& observer,
                                                   const MeasureOptions& options,
                                                   const std::function<void()>& advance = {});

}  // namespace gonio

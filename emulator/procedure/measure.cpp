#include "emulator/procedure/measure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/procedure/measured_warnings.hpp"

namespace gonio {

namespace {

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::optional<ReflectedColour> reflected_colour(const GlossReading& reading,
                                                const Glossmeter& glossmeter,
                                                const Observer& observer) {
  const Xyz xyz = tristimulus(reading.reflectance, glossmeter.source(), observer);
  if (!(xyz.X + xyz.Y + xyz.Z > 0.0)) {
    return std::nullopt;
  }
  return ReflectedColour{.xyz = xyz,
                         .xy = chromaticity(xyz),
                         .lab = cielab(xyz, white_point(glossmeter.source(), observer))};
}

/// Where to measure a sample; nothing if it states no panel.
std::optional<PanelPosition> position_on(const Sample& sample, const MeasureOptions& options) {
  if (!sample.panel && options.position) {
    throw std::invalid_argument(fmt::format(
        "{}: a position needs a sample whose file states 'panel:', this one is the same everywhere",
        sample.id));
  }
  if (!sample.panel) {
    return std::nullopt;
  }
  const PanelLayout& layout = *sample.panel->layout;
  return options.position.value_or(
      PanelPosition{.x_mm = 0.5 * layout.length_mm, .y_mm = 0.5 * layout.width_mm});
}

Spot spot_on(const Sample& sample, const Instrument& instrument, const std::string& geometry_id,
             const PanelPosition& position) {
  const PanelLayout& layout = *sample.panel->layout;
  const Spot spot = instrument.spot(geometry_id, position.x_mm, position.y_mm);
  if (!layout.carries(spot)) {
    throw std::invalid_argument(fmt::format(
        "{}: the spot of geometry {}, {:.3g} mm x {:.3g} mm at {:g} mm, {:g} mm, hangs over the "
        "edge of the panel of {:g} mm x {:g} mm",
        sample.id, geometry_id, 2.0 * spot.half_length_mm, 2.0 * spot.half_width_mm, spot.x_mm,
        spot.y_mm, layout.length_mm, layout.width_mm));
  }
  return spot;
}

SpotOnPanel spot_on_panel(const Spot& spot, const std::vector<SpotShare>& shares,
                          const PanelLayout& layout) {
  SpotOnPanel result{.spot = spot};
  if (layout.regions.size() == 1) {
    return result;
  }
  for (std::size_t region = 0; region < layout.regions.size(); ++region) {
    double share = 0.0;
    for (const SpotShare& part : shares) {
      share += part.region == region ? part.weight : 0.0;
    }
    if (share > 0.0) {
      result.regions.push_back({.id = layout.regions[region].id, .share = share});
    }
  }
  return result;
}

/// What one geometry measures: the sample's surface, or that of what its spot covers.
struct Seen {
  Surface surface;
  std::optional<SpotOnPanel> spot = {};
};

Seen seen_by(const std::string& geometry_id, const Sample& sample, const Instrument& instrument,
             const std::optional<PanelPosition>& position) {
  if (!position) {
    return {.surface = sample.surface};
  }
  const Spot spot = spot_on(sample, instrument, geometry_id, *position);
  const std::vector<SpotShare> parts = shares(*sample.panel->layout, spot);
  return {.surface = sample.panel->mixed(parts),
          .spot = spot_on_panel(spot, parts, *sample.panel->layout)};
}

}  // namespace

/// Adds what is not said yet.
void append(std::vector<std::string>& warnings, const std::vector<std::string>& more) {
  std::ranges::copy_if(more, std::back_inserter(warnings),
                       [&](const std::string& text) { return !contains(warnings, text); });
}

std::vector<std::string> geometries_asked_for(const Instrument& instrument,
                                              const std::vector<std::string>& ids) {
  const std::string& name = instrument.file.empty() ? instrument.standard.id : instrument.id;
  std::vector<std::string> asked;
  for (const std::string& id : ids) {
    if (!instrument.has(id)) {
      throw std::invalid_argument(fmt::format("{} has the geometries {}, not '{}'", name,
                                              fmt::join(instrument.geometries, ", "), id));
    }
    if (!contains(asked, id)) {
      asked.push_back(id);
    }
  }
  return asked.empty() ? instrument.geometries : asked;
}

const GeometryResult* Measurement::find(const std::string& geometry_id) const {
  for (const GeometryResult& result : geometries) {
    if (result.id == geometry_id) {
      return &result;
    }
  }
  return nullptr;
}

Measurement measure(const Sample& sample, const Glossmeter& glossmeter, const Observer& observer,
                    const MeasureOptions& options) {
  const Standard& standard = glossmeter.instrument().standard;
  Measurement measurement{.sample = sample.id, .sample_title = sample.title};
  measurement.position = position_on(sample, options);
  std::map<std::string, double> gloss;
  for (const std::string& id : geometries_asked_for(glossmeter.instrument(), options.geometries)) {
    const GeometryLimits& limits = standard.geometry(id);
    const Seen seen = seen_by(id, sample, glossmeter.instrument(), measurement.position);
    const GlossReading reading =
        glossmeter.read(seen.surface, id, options.tolerance, sample.tilt + options.tilt);
    gloss.emplace(id, reading.gloss);
    append(measurement.warnings, data_warnings(seen.surface));
    append(measurement.warnings,
           reading_warnings(seen.surface, glossmeter, id, reading, sample.tilt + options.tilt));
    measurement.geometries.push_back({.id = id,
                                      .theta_i = limits.theta_i.nominal,
                                      .reading = reading,
                                      .colour = reflected_colour(reading, glossmeter, observer),
                                      .evidence = limits.evidence(),
                                      .spot = seen.spot});
  }
  measurement.selected_geometry = standard.select_geometry(gloss);
  for (const HazeRule& rule : standard.haze) {
    measurement.haze.push_back(haze(rule, gloss));
  }
  return measurement;
}

std::vector<Measurement> measure_all(const std::vector<Sample>& samples,
                                     const Glossmeter& glossmeter, const Observer& observer,
                                     const MeasureOptions& options,
                                     const std::function<void()>& advance) {
  std::vector<Measurement> results(samples.size());
  std::mutex mutex;
  parallel_for(samples.size(), [&](std::size_t i) {
    results[i] = measure(samples[i], glossmeter, observer, options);
    if (advance) {
      const std::scoped_lock lock(mutex);
      advance();
    }
  });
  return results;
}

}  // namespace gonio

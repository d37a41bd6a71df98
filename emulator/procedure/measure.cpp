#include "emulator/procedure/measure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

namespace {

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::vector<std::string> geometries_asked_for(const Instrument& instrument,
                                              const MeasureOptions& options) {
  const std::string& name = instrument.file.empty() ? instrument.standard.id : instrument.id;
  std::vector<std::string> asked;
  for (const std::string& id : options.geometries) {
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

}  // namespace

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
  std::map<std::string, double> gloss;
  for (const std::string& id : geometries_asked_for(glossmeter.instrument(), options)) {
    const GeometryLimits& limits = standard.geometry(id);
    const GlossReading reading =
        glossmeter.read(sample.surface, id, options.tolerance, sample.tilt + options.tilt);
    gloss.emplace(id, reading.gloss);
    measurement.geometries.push_back({.id = id,
                                      .theta_i = limits.theta_i.nominal,
                                      .reading = reading,
                                      .colour = reflected_colour(reading, glossmeter, observer),
                                      .evidence = limits.evidence()});
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
